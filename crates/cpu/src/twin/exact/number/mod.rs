//! Twins of `shaders/exact/number/`: the numbers that formulas are written in. One text for four lanes, for `f32`, for wider
//! formats, and, in tests, for an arithmetic that errs wherever WGSL lets it.

pub(crate) mod double;
pub(crate) mod native;
pub(crate) mod pair;
pub(crate) mod pair_of_f64;
pub(crate) mod single;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

/// A number, or several abreast.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// One truth a lane.
    type Mask: Mask;

    /// A constant; exact.
    fn constant(x: f32) -> Self;
    fn abs(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn less(self, other: Self) -> Self::Mask;
    fn equal(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn pick(no: Self, yes: Self, mask: Self::Mask) -> Self;
}

/// One truth a lane.
pub(crate) trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Bit `k` is lane `k`.
    fn bits(self) -> u32;
}
