//! One ray, as every precision answers it.

use rayproof::files::replay;
use rayproof::scene::{FlatHit, Ray, Scene};
use rayproof::{Device, Error, Intersector, Precision};
use rayproof_oracle::Oracle;
use rayproof_oracle::worked::{Worked, work};

use super::world::World;

/// Primitives of a scene that is handed on whole, at most.
const SMALL: usize = 256;

/// What became of a ray.
#[derive(Clone)]
pub(crate) struct Inspection {
    pub(crate) ray: Ray,
    /// The answers, in the order of [`Precision::ALL`].
    pub(crate) hits: [FlatHit; 6],
    /// The oracle's.
    pub(crate) truth: FlatHit,
    /// Flat numbers of the primitives that some answer names; the scene's first ones where none does.
    pub(crate) candidates: Vec<u32>,
    /// The calculation for one primitive.
    pub(crate) worked: Option<(u32, Worked)>,
}

impl Inspection {
    /// Asks every precision, and works out the calculation for a primitive: `wanted`, or else the exact one.
    ///
    /// # Errors
    /// When the scene is too large for another tree.
    pub(crate) fn new(world: &World, ray: Ray, wanted: Option<u32>) -> Result<Self, Error> {
        let mut hits = [FlatHit::MISS; 6];
        for (hit, precision) in hits.iter_mut().zip(Precision::ALL) {
            world.on_cpu(precision)?.closest_flat(&[ray], std::slice::from_mut(hit))?;
        }
        let truth = Oracle::new(&world.scene).hit(&ray);
        let mut candidates: Vec<u32> = Vec::new();
        for hit in std::iter::once(&truth).chain(&hits).filter(|hit| hit.is_hit()) {
            if !candidates.contains(&hit.primitive) {
                candidates.push(hit.primitive);
            }
        }
        if candidates.is_empty() {
            candidates.extend((0..world.scene.len().min(8)).filter_map(|flat| u32::try_from(flat).ok()));
        }
        let chosen = wanted.filter(|&flat| (flat as usize) < world.scene.len()).or(candidates.first().copied());
        let worked = chosen.map(|flat| (flat, work(&ray, &world.scene.primitive(flat as usize))));
        Ok(Self { ray, hits, truth, candidates, worked })
    }

    /// Shell commands that ask `rayproof intersect` for the answer of a precision again, to the bit.
    pub(crate) fn commands(&self, scene: &Scene, precision: Precision) -> String {
        let (text, same) = self.case(scene, precision);
        let rays = replay::ray_file(&self.ray);
        let note = if same {
            ""
        } else {
            "# Beside the rest of its scene the answer was another: a scene's size decides how its numbers are scaled.\n"
        };
        format!(
            "{note}cat > ray.toml <<'END'\n{text}END\ncat > ray.csv <<'END'\n{rays}END\n\
             rayproof intersect ray.toml ray.csv -o - --to csv --precision {} --device cpu --check 1\n",
            precision.name()
        )
    }

    /// The scene file of the primitives that matter, and whether their answer is that of the whole scene.
    fn case(&self, scene: &Scene, precision: Precision) -> (String, bool) {
        let place = Precision::ALL.iter().position(|&p| p == precision).unwrap_or(0);
        let answer = self.hits[place];
        let mut few: Vec<u32> =
            [self.truth, answer].iter().filter(|hit| hit.is_hit()).map(|hit| hit.primitive).collect();
        few.extend(self.worked.as_ref().map(|(flat, _)| *flat));
        few.sort_unstable();
        few.dedup();
        let all: Vec<u32> = (0..scene.len().min(SMALL)).filter_map(|flat| u32::try_from(flat).ok()).collect();
        let replays = |flats: &[u32]| {
            let small = Scene::new(flats.iter().map(|&flat| scene.primitive(flat as usize).into()).collect())
                .expect("made of finite numbers");
            let mut hit = [FlatHit::MISS];
            let engine = Intersector::on(&Device::cpu(), &small, precision).ok();
            let asked = engine.and_then(|engine| engine.closest_flat(&[self.ray], &mut hit).ok()).is_some();
            let primitive = flats.get(hit[0].primitive as usize).copied().unwrap_or(hit[0].primitive);
            asked && FlatHit { primitive, ..hit[0] }.same_bits(&answer)
        };
        let (chosen, same) = match replays(&few) {
            true => (few, true),
            false if scene.len() <= SMALL => (all, true),
            false => (few, false),
        };
        (replay::scene_file(chosen.into_iter().map(|flat| scene.primitive(flat as usize))), same)
    }
}
