//! Twin of `shaders/leaf/triangles.wgsl`; here a leaf's word names its four lanes.

use super::single::{Candidate, Closest, SingleRay, closer};
use super::word::leaf_first;
use crate::lanes::{Candidates, Triangles4};

#[inline(always)]
pub(crate) fn intersect_triangles<const ANY: bool>(
    leaves: &[Triangles4],
    ray: &SingleRay,
    word: u32,
    Closest(before): Closest<ANY>,
    intersect_triangle: impl Fn(&SingleRay, &Triangles4) -> Candidates,
) -> Closest<ANY> {
    let leaf = &leaves[leaf_first(word)];
    let found = intersect_triangle(ray, leaf);
    let mut hit = before;
    let mut left = found.hits;
    while left != 0 {
        let k = left.trailing_zeros() as usize;
        left &= left - 1;
        let candidate = Candidate { hit: true, t: found.t[k], u: found.u[k], v: found.v[k] };
        hit = closer(candidate, leaf.ids[k], hit);
    }
    Closest(hit)
}
