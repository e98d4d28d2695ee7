//! Twin of `shaders/leaf/spheres.wgsl`.

use rayproof_scene::Sphere;

use super::single::{Candidate, Closest, SingleRay, closer};
use super::word::leaf_range;

#[inline(always)]
pub(crate) fn intersect_spheres<const ANY: bool>(
    spheres: &[Sphere],
    ids: &[u32],
    ray: &SingleRay,
    word: u32,
    Closest(before): Closest<ANY>,
    intersect_sphere: impl Fn(&SingleRay, &Sphere) -> Candidate,
) -> Closest<ANY> {
    let mut hit = before;
    for i in leaf_range(word) {
        hit = closer(intersect_sphere(ray, &spheres[i]), ids[i], hit);
    }
    Closest(hit)
}
