//! The two formats that engines compute in, and vectors of them as `crates/cpu/src/number.rs` has them.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Value;

/// `f32` or `f64`.
pub(super) trait Float:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Into<Value>
{
    /// Exact.
    fn widen(x: f32) -> Self;
    /// The nearest.
    fn narrow(self) -> f32;
    fn sqrt(self) -> Self;
}

impl Float for f32 {
    fn widen(x: f32) -> Self {
        x
    }
    fn narrow(self) -> f32 {
        self
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Float for f64 {
    fn widen(x: f32) -> Self {
        Self::from(x)
    }
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn narrow(self) -> f32 {
        self as f32
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

pub(super) fn sub<N: Float>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot3<N: Float>(a: [N; 3], b: [N; 3]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross3<N: Float>(a: [N; 3], b: [N; 3]) -> [N; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
