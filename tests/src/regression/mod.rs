//! A file for each fault that somebody's report taught us, named after it. Its head says who asked or saw what, of which
//! intersector, and what is right.
//!
//! Those with numbers are recorded, bit for bit, in family 41 of the hard cases.

mod embree_133;
mod embree_298;
mod embree_387;
mod embree_423;
mod embree_676;
mod embree_small_triangles;
mod oblikovati_2146;
mod open3d_occupancy;
mod pbrt_bad_cases;
mod pbrt_reintersect;
mod pbrt_watertight;
mod tinybvh_small;
mod trimesh_1496;
mod trimesh_1766;
mod trimesh_on_vertex;

use rayproof::scene::{Ray, Scene};
use rayproof_oracle::families::{self, Case};

use crate::exact::{Answers, Engines};

/// Case `index` of family 41, cut to its `recorded` rays, as both engines answer it.
fn recorded(index: usize, recorded: usize) -> [Answers; 2] {
    let mut cases = families::all()[40].cases(3, 13 * 648);
    let Case { scene, rays } = cases.swap_remove(index);
    both(&scene, &rays[..recorded])
}

/// The CPU engine's answers and the device's, where the scene is one for which it answers.
fn both(scene: &Scene, rays: &[Ray]) -> [Answers; 2] {
    let engines = Engines::new(scene);
    let cpu = engines.on_cpu(rays);
    let device = engines.on_device(rays).unwrap_or_else(|| engines.on_cpu(rays));
    [cpu, device]
}

/// Whether every ray hits, and crosses the surface once.
fn all_hit_once(answers: &Answers) -> bool {
    answers.hits.iter().all(|hit| hit.is_hit()) && answers.counts.iter().all(|&count| count == 1)
}

/// Whether ray `i` hits primitive `i`.
fn each_its_own(answers: &Answers) -> bool {
    (0..).zip(&answers.hits).all(|(i, hit)| hit.primitive == i)
}

fn all_miss(answers: &Answers) -> bool {
    answers.hits.iter().all(|hit| !hit.is_hit()) && answers.any.iter().all(|&any| any == 0)
}
