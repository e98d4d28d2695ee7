//! Formats wider than `f32`.

use crate::lanes::Corners;
use crate::twin::exact::number::Number;
use crate::twin::exact::number::pair::Two;
use crate::twin::exact::vector::Vector;

/// A format wider than `f32`.
pub(crate) trait Wide: Number<Mask = bool> + PartialOrd {
    /// A number, exact.
    fn of(x: f64) -> Self;
    /// `self 2^-exponent` as the nearest `f32`, `inverse` being `2^-exponent`; never a negative zero.
    fn nearest(self, inverse: f64) -> f32;
}

impl Wide for f64 {
    #[inline(always)]
    fn of(x: f64) -> Self {
        x
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

#[cfg(test)]
mod tests {
    use super::*;

    fn two(high: f64, low: f64) -> Two {
        Two { high, low }
    }

    #[test]
    fn a_sum_of_two_is_rounded_once() {
        let middle = 1.0 + 2.0_f64.powi(-24); // halfway between 1 and the next f32
        let tiny = 2.0_f64.powi(-90);
        assert_eq!(two(middle, 0.0).nearest(1.0), 1.0);
        assert_eq!(two(middle, tiny).nearest(1.0), 1.0_f32.next_up());
        assert_eq!(two(middle, -tiny).nearest(1.0), 1.0);
        assert_eq!(two(-middle, -tiny).nearest(1.0), -(1.0_f32.next_up()));
        // An f64 that already rounded to the middle: the low part tells from which side.
        let above = (1.0 + 3.0 * 2.0_f64.powi(-24)).next_down();
        assert_eq!(two(above, 0.4 * (above.next_up() - above)).nearest(1.0), 1.0_f32.next_up());
        // Subnormal results and the scale.
        assert_eq!(two(1.5, tiny).nearest(2.0_f64.powi(-149)), f32::from_bits(2));
        assert_eq!(two(0.5, -tiny).nearest(2.0_f64.powi(-149)), 0.0);
        assert_eq!(two(-1e-300, 0.0).nearest(1.0).to_bits(), 0, "no negative zero");
    }

    #[test]
    fn sums_products_quotients_and_roots_keep_a_hundred_bits() {
        let third = Two::from(1.0) / Two::from(3.0);
        let back = third * Two::from(3.0) - Two::from(1.0);
        assert!(back.high.abs() < 2.0_f64.powi(-100), "{back:?}");
        let root = Two::from(2.0).sqrt();
        let back = root * root - Two::from(2.0);
        assert!(back.high.abs() < 2.0_f64.powi(-99), "{back:?}");
        let cancelled = (Two::from(1.0) + Two::from(2.0_f64.powi(-80))) - Two::from(1.0);
        assert_eq!(cancelled.high, 2.0_f64.powi(-80));
    }
}
