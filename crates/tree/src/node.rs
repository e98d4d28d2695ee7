use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use rayproof_scene::Kind;

/// The word of a child slot that holds nothing.
pub const EMPTY: u32 = u32::MAX;

/// One more than the largest index of a leaf's first primitive; below it, no leaf's word is [`EMPTY`].
pub(crate) const MAX_FIRST: usize = INDEX_MASK as usize;

/// From this word on a leaf is named.
pub const LEAF: u32 = 1 << 31;
/// How many bits tell a leaf's kind, which stand below the highest.
const KIND_BITS: u32 = usize::BITS - (Kind::ALL.len() - 1).leading_zeros();
/// Where a leaf's kind stands in its word.
pub const KIND_SHIFT: u32 = 31 - KIND_BITS;
/// The kind, once it is shifted down.
pub const KIND_MASK: u32 = (1 << KIND_BITS) - 1;
/// Where the number of a leaf's primitives, less one, stands in its word.
pub const COUNT_SHIFT: u32 = KIND_SHIFT - 2;
/// The index of a leaf's first primitive.
pub const INDEX_MASK: u32 = (1 << COUNT_SHIFT) - 1;

/// The finest grid step, so that no decoded plane needs a subnormal.
const MIN_STEP: f32 = f32::from_bits((127 - 100) << 23);

/// What a child slot names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Child {
    /// Nothing.
    Empty,
    /// The inner node of that index.
    Node(usize),
    /// `count` (1 to 4) primitives of a kind from `first`, an index among those of that kind.
    Leaf {
        /// Their kind.
        kind: Kind,
        /// The index of the first.
        first: usize,
        /// How many.
        count: usize,
    },
}

impl Child {
    /// The word that kernels read: a leaf has its highest bit set, then come the kind, the count less one and the index
    /// ([`KIND_SHIFT`], [`COUNT_SHIFT`], [`INDEX_MASK`]).
    #[expect(clippy::cast_possible_truncation, reason = "Bvh::new bounds the number of primitives by INDEX_MASK")]
    pub const fn word(self) -> u32 {
        match self {
            Self::Empty => EMPTY,
            Self::Node(index) => index as u32,
            Self::Leaf { kind, first, count } => {
                LEAF | (kind as u32) << KIND_SHIFT | (count as u32 - 1) << COUNT_SHIFT | first as u32
            }
        }
    }

    /// What a word names.
    ///
    /// # Panics
    /// When it is no child's word.
    #[must_use]
    pub const fn from_word(word: u32) -> Self {
        if word == EMPTY {
            return Self::Empty;
        }
        if word & LEAF == 0 {
            return Self::Node(word as usize);
        }
        let first = (word & INDEX_MASK) as usize;
        let count = ((word >> COUNT_SHIFT) & 3) as usize + 1;
        Self::Leaf { kind: Kind::ALL[((word >> KIND_SHIFT) & KIND_MASK) as usize], first, count }
    }
}

/// An inner node: four child boxes on an 8-bit grid. 64 bytes, as on the device.
///
/// Plane `q` of axis `i` lies at `origin[i] + q step[i]`, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Node {
    /// Where the grid starts, a multiple of `step`.
    pub origin: [f32; 3],
    /// The grid's step on each axis, a power of two.
    pub step: [f32; 3],
    /// For each axis, byte `k` is the low plane of child `k`.
    pub low: [u32; 3],
    /// For each axis, byte `k` is the high plane of child `k`.
    pub high: [u32; 3],
    /// What each slot holds; see [`Child`].
    pub children: [u32; 4],
}

impl Node {
    /// The node of up to four children with their boxes `[low, high]`.
    pub(crate) fn new(boxes: &[[Vec3; 2]], children: [u32; 4]) -> Self {
        let mut node = Self { origin: [0.0; 3], step: [MIN_STEP; 3], low: [0; 3], high: [0; 3], children };
        for axis in 0..3 {
            let low = boxes.iter().map(|b| b[0][axis]).fold(f32::INFINITY, f32::min);
            let high = boxes.iter().map(|b| b[1][axis]).fold(f32::NEG_INFINITY, f32::max);
            if boxes.is_empty() {
                continue;
            }
            let step = grid_step(low, high);
            let start = (f64::from(low) / step).floor();
            node.origin[axis] = narrow(start * step);
            node.step[axis] = narrow(step);
            for (k, b) in boxes.iter().enumerate() {
                node.low[axis] |= byte((f64::from(b[0][axis]) / step).floor() - start) << (8 * k);
                node.high[axis] |= byte((f64::from(b[1][axis]) / step).ceil() - start) << (8 * k);
            }
        }
        node
    }

    /// The box `[low, high]` of child `k`, as every engine decodes it.
    #[must_use]
    pub fn child_box(&self, k: usize) -> [Vec3; 2] {
        let plane = |words: &[u32; 3], axis: usize| {
            let q = ((words[axis] >> (8 * k)) & 255) as f32;
            q * self.step[axis] + self.origin[axis]
        };
        [0, 1].map(|side| {
            let words = if side == 0 { &self.low } else { &self.high };
            Vec3::new(plane(words, 0), plane(words, 1), plane(words, 2))
        })
    }
}

/// An inner node of eight children with their boxes as they are, for processors: the first slots are in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EightBoxes {
    /// The boxes, `[low, high]`; nothing in a slot that is empty.
    pub boxes: [[Vec3; 2]; 8],
    /// What each slot holds; see [`Child`].
    pub children: [u32; 8],
}

impl EightBoxes {
    pub(crate) fn new(boxes: &[[Vec3; 2]], children: [u32; 8]) -> Self {
        let mut all = [[Vec3::ZERO; 2]; 8];
        all[..boxes.len()].copy_from_slice(boxes);
        Self { boxes: all, children }
    }
}

/// The smallest power of two on whose grid `low..high` spans at most 255 cells and each plane is an `f32`.
///
/// Quotients by a power of two are exact in `f64`, so floor and ceil are too.
fn grid_step(low: f32, high: f32) -> f64 {
    let (low, high) = (f64::from(low), f64::from(high));
    // A plane k step with |k| <= 2^24 is an f32; rounding outward adds at most one step to the magnitude.
    let exact = low.abs().max(high.abs()) / f64::from((1 << 24) - 1);
    let guess = exact.max((high - low) / 255.0).max(f64::from(MIN_STEP));
    // A power of two at or just above the guess: clear the mantissa, and double while something does not fit.
    let mut step = f64::from_bits(guess.to_bits() & !((1 << 52) - 1));
    while step < guess || (high / step).ceil() - (low / step).floor() > 255.0 {
        step *= 2.0;
    }
    step
}

/// A number that is an `f32` already.
#[expect(clippy::cast_possible_truncation, reason = "exact by the choice of the grid")]
fn narrow(x: f64) -> f32 {
    x as f32
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255 by the choice of the grid")]
fn byte(q: f64) -> u32 {
    debug_assert!((0.0..=255.0).contains(&q), "plane {q} is off the grid");
    q as u32
}

#[cfg(test)]
mod tests {
    use rayproof_scene::random::Random;

    use super::*;

    /// Log-uniform magnitudes of both signs.
    fn numbers(seed: u64) -> impl Iterator<Item = f32> {
        let mut random = Random::new(seed, 0);
        std::iter::repeat_with(move || {
            let state = random.bits();
            let sign = (state >> 63) as u32;
            let exponent = 127 - 60 + ((state >> 40) % 120) as u32;
            f32::from_bits((sign << 31) | (exponent << 23) | ((state >> 17) & 0x7f_ffff) as u32)
        })
    }

    #[test]
    fn decoded_boxes_hold_what_was_put_in() {
        let mut n = numbers(7);
        let mut v = || Vec3::new(n.next().unwrap_or(0.0), n.next().unwrap_or(0.0), n.next().unwrap_or(0.0));
        for round in 0..20_000 {
            let boxes: Vec<[Vec3; 2]> = (0..1 + round % 4)
                .map(|_| {
                    let (p, q) = (v(), v());
                    // A third are flat, a third tiny beside their place.
                    let q = [q, p, p + p * 1e-6][round % 3];
                    [p.min(q), p.max(q)]
                })
                .collect();
            let node = Node::new(&boxes, [EMPTY; 4]);
            for (k, b) in boxes.iter().enumerate() {
                let [low, high] = node.child_box(k);
                assert!(low.cmple(b[0]).all() && high.cmpge(b[1]).all(), "round {round}: {b:?} leaves {low} {high}");
                for axis in 0..3 {
                    // Exact: the same sum in f64 is the same number.
                    let q = f64::from((node.low[axis] >> (8 * k)) & 255);
                    let exact = q * f64::from(node.step[axis]) + f64::from(node.origin[axis]);
                    assert_eq!(f64::from(low[axis]), exact, "round {round}");
                }
            }
        }
    }

    #[test]
    fn boxes_are_tight_to_a_cell() {
        let boxes = [[Vec3::ZERO, Vec3::ONE], [Vec3::splat(0.25), Vec3::splat(0.5)]];
        let node = Node::new(&boxes, [EMPTY; 4]);
        assert_eq!(node.step, [1.0 / 128.0; 3]);
        assert_eq!(node.child_box(1), boxes[1]);
    }

    #[test]
    fn the_largest_boxes_decode() {
        let far = Vec3::splat(2.0_f32.powi(101));
        assert_eq!(Node::new(&[[-far, far]], [EMPTY; 4]).child_box(0), [-far, far]);
    }

    #[test]
    fn words_read_back() {
        let last = MAX_FIRST - 1;
        let leaves = Kind::ALL
            .map(|kind| [Child::Leaf { kind, first: 0, count: 1 }, Child::Leaf { kind, first: last, count: 4 }]);
        for child in [Child::Empty, Child::Node(0), Child::Node(123_456)].into_iter().chain(leaves.concat()) {
            assert_eq!(Child::from_word(child.word()), child);
        }
    }
}
