//! Twin of `shaders/leaf/word.wgsl`.

use std::ops::Range;

use rayproof_scene::Kind;
use rayproof_tree::{COUNT_SHIFT, INDEX_MASK, KIND_MASK, KIND_SHIFT};

#[inline(always)]
pub(crate) const fn leaf_kind(word: u32) -> Kind {
    Kind::ALL[(word >> KIND_SHIFT & KIND_MASK) as usize]
}

#[inline(always)]
pub(crate) const fn leaf_first(word: u32) -> usize {
    (word & INDEX_MASK) as usize
}

#[inline(always)]
pub(crate) const fn leaf_count(word: u32) -> usize {
    (word >> COUNT_SHIFT & 3) as usize + 1
}

/// The indices of a leaf's primitives.
#[inline(always)]
pub(crate) const fn leaf_range(word: u32) -> Range<usize> {
    leaf_first(word)..leaf_first(word) + leaf_count(word)
}

/// A primitive's place in the leaves: its kind in the two upper bits, its index in the others.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a leaf's word names it in 28 bits, and it holds four")]
pub(crate) const fn place_of(kind: Kind, index: usize) -> u32 {
    (kind as u32) << 30 | index as u32
}

#[inline(always)]
pub(crate) const fn place_kind(place: u32) -> Kind {
    Kind::ALL[(place >> 30) as usize]
}

#[inline(always)]
pub(crate) const fn place_index(place: u32) -> usize {
    (place & 0x3fff_ffff) as usize
}
