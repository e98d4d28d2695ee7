//! Twins of `shaders/leaf/`: what a leaf's word names, and the closer of two hits.

use rayproof_scene::bvh::PackedTriangle;
use rayproof_scene::{Hit, Sphere};

use crate::batch::{Candidate, TierRay};

/// Bit 30 of a leaf's word: it holds spheres.
pub(crate) const SPHERES: u32 = 1 << 30;

#[inline(always)]
fn closer(found: Candidate, id: u32, hit: Hit) -> Hit {
    if found.hit && (found.t < hit.t || (found.t == hit.t && id < hit.primitive)) {
        return Hit { t: found.t, u: found.u, v: found.v, primitive: id };
    }
    hit
}

#[inline(always)]
const fn leaf_range(word: u32) -> std::ops::Range<usize> {
    let first = (word & 0x0fff_ffff) as usize;
    first..first + ((word >> 28) & 3) as usize + 1
}

/// Twin of `shaders/leaf/triangles.wgsl`.
#[inline(always)]
pub(crate) fn intersect_triangles(
    triangles: &[PackedTriangle],
    ray: &TierRay,
    word: u32,
    before: Hit,
    intersect_triangle: impl Fn(&TierRay, &PackedTriangle) -> Candidate,
) -> Hit {
    let mut hit = before;
    for triangle in &triangles[leaf_range(word)] {
        hit = closer(intersect_triangle(ray, triangle), triangle.id, hit);
    }
    hit
}

/// Twin of `shaders/leaf/spheres.wgsl`.
#[inline(always)]
pub(crate) fn intersect_spheres(
    spheres: &[Sphere],
    ids: &[u32],
    ray: &TierRay,
    word: u32,
    before: Hit,
    intersect_sphere: impl Fn(&TierRay, &Sphere) -> Candidate,
) -> Hit {
    let mut hit = before;
    for i in leaf_range(word) {
        hit = closer(intersect_sphere(ray, &spheres[i]), ids[i], hit);
    }
    hit
}
