//! One ray as two small files that `rayproof intersect` answers again.

use rayproof::files::replay;
use rayproof::scene::{FlatHit, Primitive, Ray, Scene, number};

use super::Error;
use super::subject::{Bench, Subject, Walk};
use super::tally::{Place, Tally};
use super::truth::Truth;
use crate::model::{Case, Errors};

/// Primitives that a case may have.
const MOST: usize = 256;

/// A scene, its rays and their exact answers: what places refer to.
pub(crate) struct Asked {
    pub(crate) scene: Scene,
    pub(crate) rays: Vec<Ray>,
    pub(crate) truth: Vec<Truth>,
}

impl Asked {
    pub(crate) fn new(scene: Scene, rays: Vec<Ray>) -> Self {
        let truth = Truth::of(&scene, &rays);
        Self { scene, rays, truth }
    }

    /// Answers to these rays alone.
    pub(crate) fn tally(&self, hits: &[FlatHit]) -> Tally {
        let mut tally = Tally::default();
        tally.add(0, &self.scene, &self.rays, &self.truth, hits);
        tally
    }
}

/// A tally's errors, with its worst ray and its first wrong one as cases.
pub(crate) fn errors(bench: &Bench<'_>, subject: Subject, asked: &[Asked], tally: Tally) -> Result<Errors, Error> {
    let (worst, wrong) = (tally.worst, tally.first_wrong);
    let worst = worst.map(|(ulp, place)| case(bench, subject, &asked[place.scene], place, Some(ulp))).transpose()?;
    let first_wrong = wrong.map(|place| case(bench, subject, &asked[place.scene], place, None)).transpose()?;
    Ok(Errors { worst, first_wrong, ..tally.errors() })
}

fn case(
    bench: &Bench<'_>,
    subject: Subject,
    asked: &Asked,
    Place { ray, answer, .. }: Place,
    ulp: Option<f64>,
) -> Result<Case, Error> {
    let (ray, truth) = (asked.rays[ray], &asked.truth[ray]);
    let answers = [truth.hit, answer];
    let small = alone(bench, subject, &ray, answers, &involved(&asked.scene, answers), ulp)?;
    if small.replays || asked.scene.len() > MOST {
        return Ok(small);
    }
    // A scene's size decides by how much it is scaled, which tells where parts of numbers underflow.
    let all: Vec<_> = (0..).zip((0..asked.scene.len()).map(|flat| asked.scene.primitive(flat))).collect();
    alone(bench, subject, &ray, answers, &all, ulp)
}

/// The case of these primitives alone, each with its flat number.
fn alone(
    bench: &Bench<'_>,
    subject: Subject,
    ray: &Ray,
    answers: [FlatHit; 2],
    primitives: &[(u32, Primitive)],
    ulp: Option<f64>,
) -> Result<Case, Error> {
    let small = Scene::new(primitives.iter().map(|&(_, primitive)| primitive.into()).collect())
        .expect("made of finite numbers");
    let renumbered = |hit: FlatHit| {
        let place = primitives.iter().position(|&(flat, _)| flat == hit.primitive);
        FlatHit { primitive: place.and_then(|i| u32::try_from(i).ok()).unwrap_or(hit.primitive), ..hit }
    };
    let [exact, answer] = answers.map(renumbered);
    let mut again = [FlatHit::MISS];
    bench.ready(subject, &small, Walk::Tree)?.closest(&[*ray], &mut again)?;
    Ok(Case {
        scene: replay::scene_file(primitives.iter().map(|&(_, primitive)| primitive)),
        rays: replay::ray_file(ray),
        exact: in_words(&exact),
        answer: in_words(&answer),
        ulp,
        replays: again[0].same_bits(&answer),
    })
}

/// The primitives that two answers name, in the order of the scene; its first where they name none.
fn involved(scene: &Scene, answers: [FlatHit; 2]) -> Vec<(u32, Primitive)> {
    let named = answers.iter().filter(|hit| (hit.primitive as usize) < scene.len()).map(|hit| hit.primitive);
    let mut flat: Vec<u32> = named.collect();
    flat.sort_unstable();
    flat.dedup();
    if flat.is_empty() && !scene.is_empty() {
        flat.push(0);
    }
    flat.into_iter().map(|flat| (flat, scene.primitive(flat as usize))).collect()
}

fn in_words(hit: &FlatHit) -> String {
    if !hit.is_hit() {
        return "miss".to_owned();
    }
    format!("hit {}, t = {} ({:?})", hit.primitive, number::hex(hit.t), hit.t)
}
