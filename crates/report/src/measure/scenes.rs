//! Whole scenes: millions of rays a second, and the errors of a sample of the same rays.

use glam::DVec3;
use rayproof::rays::{Diffuse, Incoherent, Primary};
use rayproof::scene::{Camera, FlatHit, Geometry, Kind, Ray, Scene, Sphere};
use rayproof_oracle::families::{Draw, meshes};

use super::case::errors;
use super::plan::Progress;
use super::statistics::timing;
use super::subject::{Answers, Subject, Walk, fast_of};
use super::timing::{Timed, Times, interleaved};
use super::{Error, Run};
use crate::model::{Errors, SceneEntry, SceneRow, Timing};
use crate::page;

/// The kinds of rays.
const KINDS: [&str; 3] = ["primary", "incoherent", "diffuse"];

/// How often a tree is built to take the time.
const BUILDS: u32 = 3;

/// A scene and what it is called.
pub struct Named {
    /// Such as `bunny.ply`.
    pub name: String,
    /// The scene.
    pub scene: Scene,
}

/// The made scenes: a torus, and spheres at random places.
pub(crate) fn made(run: &Run<'_>) -> Vec<Named> {
    let count = run.plan.primitives;
    let side = f64::from(count / 2).sqrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "about so many")]
    let mesh = meshes::torus((side * 2.0) as u32, (side / 2.0) as u32, 0.4);
    let mut draw = Draw::new(run.plan.seed, 104, 0);
    let mut sphere = |_| {
        let center = DVec3::new(draw.range(0.0, 1.0), draw.range(0.0, 1.0), draw.range(0.0, 1.0));
        let radius = draw.range(0.1, 0.5) / f64::from(count).cbrt();
        Sphere { center: center.as_vec3(), radius: DVec3::splat(radius).as_vec3().x }
    };
    let spheres: Vec<Sphere> = (0..count).map(&mut sphere).collect();
    let torus = format!("torus, {} triangles", page::count(mesh.triangles.len() as u64));
    vec![
        Named { name: torus, scene: Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers") },
        Named {
            name: format!("{} random spheres", page::count(count.into())),
            scene: Scene::new(vec![Geometry::Spheres(spheres)]).expect("made of finite numbers"),
        },
    ]
}

pub(crate) fn measure(
    run: &mut Run<'_>,
    scenes: &[Named],
    progress: &mut dyn Progress,
) -> Result<Vec<SceneRow>, Error> {
    progress.stage("scenes", scenes.len() * KINDS.len());
    let mut rows = Vec::new();
    for Named { name, scene } in scenes {
        let builds = builds(run, scene)?;
        for kind in KINDS {
            let rays = rays(scene, kind, run.plan.scene, run.plan.seed)?;
            let rows_of = if rays.is_empty() { Vec::new() } else { entries(run, scene, &rays, &builds)? };
            rows.push(SceneRow { scene: name.clone(), rays: kind.to_owned(), rows: rows_of });
            progress.step();
        }
    }
    Ok(rows)
}

/// Seconds that each subject's tree takes to build, a few times.
fn builds(run: &Run<'_>, scene: &Scene) -> Result<Vec<Vec<f64>>, Error> {
    let once = |subject: Subject| Ok(run.bench.ready(subject, scene, Walk::Tree)?.build_seconds());
    let several = |&subject: &Subject| (0..BUILDS).map(|_| once(subject)).collect();
    run.bench.subjects_on(scene.count(Kind::Sphere) > 0).iter().map(several).collect()
}

fn entries(run: &mut Run<'_>, scene: &Scene, rays: &[Ray], builds: &[Vec<f64>]) -> Result<Vec<SceneEntry>, Error> {
    let subjects = run.bench.subjects_on(scene.count(Kind::Sphere) > 0);
    let mut ready = subjects
        .iter()
        .map(|&s| run.bench.ready(s, scene, Walk::Tree))
        .collect::<Result<Vec<Box<dyn Answers>>, _>>()?;
    let mut peers = run.rivals.on(scene);
    let ours = ready.iter_mut().map(|r| r as &mut dyn Timed);
    let mut contestants: Vec<&mut dyn Timed> = ours.chain(peers.iter_mut().map(|p| p as &mut dyn Timed)).collect();
    let mut times = interleaved(&mut contestants, rays, run.plan.runs);
    let sample = sample(rays, run.plan.sample, &mut Draw::new(run.plan.seed, 106, 0));
    let mut answers = Vec::new();
    for ready in &ready {
        let mut hits = vec![FlatHit::MISS; sample.len()];
        ready.closest(&sample, &mut hits)?;
        answers.push(hits);
    }
    drop(ready);
    let theirs = times.split_off(subjects.len());
    let ours = times.into_iter().collect::<Result<Vec<Times>, _>>()?;
    let asked = [run.ask(scene.clone(), sample)];
    let mut entries = Vec::new();
    for (((&subject, times), builds), hits) in subjects.iter().zip(&ours).zip(builds).zip(&answers) {
        let errors = errors(&run.bench, subject, &asked, asked[0].tally(hits))?;
        let entry = entry(run.bench.name(subject), timing(builds.clone()), times, rays.len(), errors);
        let of_fast = Some(ours[fast_of(&subjects, subject)].over(times));
        entries.push(SceneEntry { of_fast, ..entry });
    }
    for (mut peer, times) in peers.into_iter().zip(theirs) {
        let mut hits = vec![FlatHit::MISS; asked[0].rays.len()];
        let judged = times.and_then(|times| {
            peer.closest(&asked[0].rays, &mut hits).map_err(Error::Peer)?;
            Ok(times)
        });
        match judged {
            Ok(times) => {
                let errors = asked[0].tally(&hits).errors();
                let build = timing(vec![peer.build_seconds()]);
                let entry = entry(peer.name().to_owned(), build, &times, rays.len(), errors);
                entries.push(SceneEntry { peer: true, ..entry });
            }
            Err(e) => run.rivals.absent(peer.name(), &e.to_string()),
        }
    }
    Ok(entries)
}

fn entry(who: String, build: Timing, times: &Times, rays: usize, errors: Errors) -> SceneEntry {
    let rate = |seconds: f64| rays as f64 / seconds / 1e6;
    let (mrays, kernel_mrays) = (times.wall_as(rate), times.kernel_as(rate));
    SceneEntry { who, peer: false, build, mrays, kernel_mrays, of_fast: None, errors }
}

/// So many of the rays, drawn at random: an even stride might follow a column of the picture.
pub(crate) fn sample(rays: &[Ray], count: usize, draw: &mut Draw) -> Vec<Ray> {
    (0..count.min(rays.len())).map(|_| rays[draw.below(rays.len())]).collect()
}

/// About so many rays of a kind; none where the camera sees nothing.
fn rays(scene: &Scene, kind: &str, count: usize, seed: u64) -> Result<Vec<Ray>, Error> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a root of a count in memory")]
    let side = (count as f64).sqrt() as u32;
    let primary = Primary { camera: &Camera::framing(scene), width: side, height: side };
    let mut rays = Vec::with_capacity(count);
    match kind {
        "primary" => rays.extend(primary.blocks(count).flatten()),
        "incoherent" => rays.extend(Incoherent::new(scene, seed).rays(0..count as u64)),
        _ => Diffuse::new(scene, primary, |_| ())?.send(count as u64, seed, |block| {
            rays.extend_from_slice(block);
            Ok::<(), Error>(())
        })?,
    }
    Ok(rays)
}
