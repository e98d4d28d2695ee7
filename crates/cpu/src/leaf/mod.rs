//! Twins of `shaders/leaf/`: what a leaf's word names, and the closer of two hits.

use rayproof_scene::{Hit, Sphere};

use crate::batch::{Candidate, Nearest, SingleRay};
use crate::lanes::{Candidates, Triangles4};

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
pub(crate) const fn leaf_range(word: u32) -> std::ops::Range<usize> {
    let first = (word & 0x0fff_ffff) as usize;
    first..first + ((word >> 28) & 3) as usize + 1
}

/// Twin of `shaders/leaf/triangles.wgsl`; here a leaf's word names its four lanes.
#[inline(always)]
pub(crate) fn intersect_triangles<const ANY: bool>(
    leaves: &[Triangles4],
    ray: &SingleRay,
    word: u32,
    Nearest(before): Nearest<ANY>,
    intersect_triangle: impl Fn(&SingleRay, &Triangles4) -> Candidates,
) -> Nearest<ANY> {
    let leaf = &leaves[leaf_range(word).start];
    let found = intersect_triangle(ray, leaf);
    let mut hit = before;
    let mut left = found.hits;
    while left != 0 {
        let k = left.trailing_zeros() as usize;
        left &= left - 1;
        let candidate = Candidate { hit: true, t: found.t[k], u: found.u[k], v: found.v[k] };
        hit = closer(candidate, leaf.ids[k], hit);
    }
    Nearest(hit)
}

/// Twin of `shaders/leaf/spheres.wgsl`.
#[inline(always)]
pub(crate) fn intersect_spheres<const ANY: bool>(
    spheres: &[Sphere],
    ids: &[u32],
    ray: &SingleRay,
    word: u32,
    Nearest(before): Nearest<ANY>,
    intersect_sphere: impl Fn(&SingleRay, &Sphere) -> Candidate,
) -> Nearest<ANY> {
    let mut hit = before;
    for i in leaf_range(word) {
        hit = closer(intersect_sphere(ray, &spheres[i]), ids[i], hit);
    }
    Nearest(hit)
}
