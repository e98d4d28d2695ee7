//! Formats wider than `f32`.

use super::two::Two;
use crate::lanes::Corners;
use crate::number::{Number, Vector};

/// A format wider than `f32`.
pub(crate) trait Wide: Number<Mask = bool> + PartialOrd {
    /// A number, exact.
    fn of(x: f64) -> Self;
    /// An `f64` that is at most this, and one that is at least this.
    fn between(self) -> [f64; 2];
    /// `self 2^-exponent` as the nearest `f32`, `inverse` being `2^-exponent`; never a negative zero.
    fn nearest(self, inverse: f64) -> f32;
}

impl Wide for f64 {
    #[inline(always)]
    fn of(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn between(self) -> [f64; 2] {
        [self; 2]
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn nearest(self, inverse: f64) -> f32 {
        (self * inverse) as f32 + 0.0
    }
}

impl Wide for Two {
    fn of(x: f64) -> Self {
        x.into()
    }
    fn between(self) -> [f64; 2] {
        [self.high.next_down(), self.high.next_up()]
    }
    /// Rounded to odd first: of the two `f64` around the sum the one whose last bit is 1, so that rounding again is as rounding
    /// once.
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn nearest(self, inverse: f64) -> f32 {
        let Self { high, low } = self;
        let odd = if low == 0.0 || high.to_bits() & 1 == 1 {
            high
        } else if low > 0.0 {
            high.next_up()
        } else {
            high.next_down()
        };
        (odd * inverse) as f32 + 0.0
    }
}

impl<N: Wide> Corners<N> {
    /// Corners as they are, with the largest component of the edges rounded up.
    #[inline(always)]
    pub(crate) fn widened(corners: [[f64; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(|p| Vector::from(p).map(N::of));
        let edge = (b - a).largest().max((c - a).largest()) * N::constant(1.000_001);
        Self { a, b, c, edge }
    }
}
