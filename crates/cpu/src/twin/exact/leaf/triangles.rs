//! Twin of `shaders/exact/leaf/triangles.wgsl`, four triangles abreast.

use glam::Vec4;
use rayproof_scene::Kind;

use super::Take;
use super::candidate::Candidate;
use crate::lanes::Triangles4;
use crate::twin::bvh::slab::FARTHEST;
use crate::twin::exact::number::Number as _;
use crate::twin::exact::ray::FirstRay;
use crate::twin::exact::triangle::{Estimate, plane_t, sides, triangle_crosses, triangle_misses};
use crate::twin::leaf::word::{leaf_count, leaf_first, place_of};

/// With the triangles of a leaf that are not certainly missed.
#[inline(always)]
pub(crate) fn intersect_triangles<F: Take>(leaves: &[Triangles4], ray: &FirstRay, word: u32, before: F) -> F {
    let index = leaf_first(word);
    let leaf = &leaves[index];
    let line = ray.line.lanes();
    let s = sides(&line, &leaf.corners);
    let mut left = !triangle_misses(&s).bitmask() & 0b1111 >> (4 - leaf_count(word));
    let mut found = before;
    if left == 0 {
        return found;
    }
    let crosses = triangle_crosses(&s);
    let Estimate { clear, value: t, off } = plane_t(&line, &s, leaf.corners.edge);
    let low = Vec4::pick(Vec4::splat(-FARTHEST), t - off, clear);
    let high = Vec4::pick(Vec4::splat(FARTHEST), t + off, clear);
    let certain = (crosses & clear).bitmask();
    while left != 0 {
        let k = left.trailing_zeros() as usize;
        left &= left - 1;
        let candidate = Candidate { certain: certain >> k & 1 == 1, low: low[k], high: high[k] };
        found = found.take(ray, candidate, place_of(Kind::Triangle, index * 4 + k));
    }
    found
}
