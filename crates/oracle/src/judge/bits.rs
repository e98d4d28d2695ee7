use std::fmt;

use rayproof_scene::FlatHit;

use super::judged_ray::{bits, show_hit};

/// How many `f32` numbers lie from one to the other, in the order of the reals; both zeros are one number.
///
/// [`u64::MAX`] where either is not a number.
#[must_use]
pub fn ulp_distance(a: f32, b: f32) -> u64 {
    if a.is_nan() || b.is_nan() {
        return u64::MAX;
    }
    let place = |x: f32| {
        let magnitude = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    place(a).abs_diff(place(b))
}

/// What came of comparing two engines' hits bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct BitComparison {
    /// The lengths of the two lists.
    pub lengths: [usize; 2],
    /// How many rays have a row in both.
    pub compared: usize,
    /// How many of those hit, by the first list.
    pub hits: usize,
    /// How many of those differ in any bit.
    pub different: usize,
    /// The first of those: the ray's index and its two rows; at most [`BitComparison::SHOWN`].
    pub first: Vec<(usize, [FlatHit; 2])>,
}

impl BitComparison {
    /// How many differences are kept.
    pub const SHOWN: usize = 8;

    /// Whether both lists hold the same rows, and at least `hits` of them hit something: a comparison that judged
    /// nothing has shown nothing.
    #[must_use]
    pub fn agrees(&self, hits: usize) -> bool {
        self.lengths[0] == self.lengths[1] && self.different == 0 && self.hits >= hits
    }
}

/// Compares two engines that must agree in every bit, such as a kernel and its twin.
#[must_use]
pub fn compare_bits(a: &[FlatHit], b: &[FlatHit]) -> BitComparison {
    let pairs = || a.iter().zip(b);
    let mut different = pairs().enumerate().filter(|(_, (a, b))| !a.same_bits(b));
    let first: Vec<_> = different.by_ref().take(BitComparison::SHOWN).map(|(i, (a, b))| (i, [*a, *b])).collect();
    BitComparison {
        lengths: [a.len(), b.len()],
        compared: pairs().count(),
        hits: pairs().filter(|(a, _)| a.is_hit()).count(),
        different: first.len() + different.count(),
        first,
    }
}

impl fmt::Display for BitComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { lengths: [a, b], compared, hits, different, first } = self;
        writeln!(f, "{compared} rays compared, {hits} of them hits, {different} different; lists of {a} and {b}")?;
        for (ray, rows) in first {
            writeln!(f, "  ray {ray}")?;
            for row in rows {
                writeln!(f, "    {}", show_hit(row))?;
            }
            let [x, y] = rows;
            let parts = [("t", x.t, y.t), ("u", x.u, y.u), ("v", x.v, y.v)];
            for (name, x, y) in parts.into_iter().filter(|(_, x, y)| x.to_bits() != y.to_bits()) {
                writeln!(f, "    {name}: {} against {}, {} ULP", bits(x), bits(y), ulp_distance(x, y))?;
            }
        }
        Ok(())
    }
}
