//! Twin of `shaders/bvh/every.wgsl`: no tree, every ray is tested with every primitive.

use super::traverse::Found;

/// What all leaves add, whose words these are.
#[inline(always)]
pub(crate) fn traverse<R, F: Found>(words: &[u32], ray: &R, start: F, intersect_leaf: impl Fn(&R, u32, F) -> F) -> F {
    words.iter().fold(start, |found, &word| intersect_leaf(ray, word, found))
}
