//! Family 42: batches of the sizes where indexing breaks, with answers that name the ray they belong to.

use glam::{DVec3, Vec3};
use rayproof_scene::{FlatHit, Geometry, Ray, Scene, Sphere};

use super::Case;

/// Sizes around a workgroup, around the 65,535 workgroups of one dimension, and past them times 64.
pub const BATCH_SIZES: &[usize] = &[0, 1, 63, 64, 65, 65_536, 65_537, 4_194_305];

/// How many spheres the scene of a batch has, in a row along x, two apart.
const SPHERES: usize = 64;
/// How many distances to a sphere there are before they repeat.
const DISTANCES: usize = 65_521;

/// A batch of any size over one small scene; [`batch_answer`] gives each ray's closest hit.
///
/// Only the pair of sphere and distance tells the rays apart: it repeats after 64 x 65,521 = 4,193,344 rays.
#[must_use]
pub fn batch(rays: usize) -> Case {
    let spheres = (0..SPHERES).map(|i| Sphere { center: (center(i)).as_vec3(), radius: 1.0 }).collect();
    let ray = |i: usize| {
        let origin = center(i % SPHERES) + DVec3::Z * (distance(i) + 1.0);
        // One in seven looks away and misses.
        Ray::new(origin.as_vec3(), if i % 7 == 6 { Vec3::Z } else { Vec3::NEG_Z })
    };
    Case {
        scene: Scene::new(vec![Geometry::Spheres(spheres)]).expect("made of finite numbers"),
        rays: (0..rays).map(ray).collect(),
    }
}

/// The exact closest hit of ray `i` of a [`batch`].
#[must_use]
pub fn batch_answer(i: usize) -> FlatHit {
    if i % 7 == 6 {
        return FlatHit::MISS;
    }
    let primitive = u32::try_from(i % SPHERES).expect("there are few spheres");
    FlatHit { t: super::aim::round(distance(i)), u: 0.0, v: 0.0, primitive }
}

fn center(i: usize) -> DVec3 {
    DVec3::X * (2 * i) as f64
}

fn distance(i: usize) -> f64 {
    (1 + i % DISTANCES) as f64
}

/// The small sizes as far as they fit, and one batch of the rest.
pub(super) fn cases(rays: usize) -> Vec<Case> {
    let mut left = rays;
    let mut sizes: Vec<usize> = Vec::new();
    for &size in &BATCH_SIZES[1..] {
        if size <= left {
            sizes.push(size);
            left -= size;
        }
    }
    sizes.push(left);
    sizes.into_iter().filter(|&size| size > 0).map(batch).collect()
}
