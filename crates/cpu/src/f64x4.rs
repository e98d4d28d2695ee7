//! Numbers of twice the width of `f32`: `f64`, pairs of `f32`, and four of each abreast.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use glam::Vec4;

use crate::twin::exact::number::pair::{Part, Two};
use crate::twin::exact::number::{Mask, Number};

/// A format of twice the width of `Single`.
pub(crate) trait Double: Number {
    type Single;

    /// Exact.
    fn widen(x: Self::Single) -> Self;
    /// The nearest.
    fn narrow(self) -> Self::Single;
}

impl Double for f64 {
    type Single = f32;

    #[inline(always)]
    fn widen(x: f32) -> Self {
        Self::from(x)
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn narrow(self) -> f32 {
        self as f32
    }
}

impl<P: Part> Double for Two<P> {
    type Single = P;

    #[inline(always)]
    fn widen(x: P) -> Self {
        x.into()
    }
    #[inline(always)]
    fn narrow(self) -> P {
        self.high
    }
}

/// Four `f64` abreast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct F64x4([f64; 4]);

/// Four truths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bool4([bool; 4]);

/// One result a lane.
#[inline(always)]
fn lanes<T>(f: impl Fn(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}

macro_rules! by_lane {
    ($kind:ident, $($operator:ident $name:ident)+) => {$(
        impl $operator for $kind {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(lanes(|k| self.0[k].$name(other.0[k])))
            }
        }
    )+};
}

by_lane!(F64x4, Add add  Sub sub  Mul mul  Div div);
by_lane!(Bool4, BitAnd bitand  BitOr bitor);

impl Not for Bool4 {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(bool::not))
    }
}

impl Mask for Bool4 {
    #[inline(always)]
    fn bits(self) -> u32 {
        let [a, b, c, d] = self.0.map(u32::from);
        a | b << 1 | c << 2 | d << 3
    }
}

impl Number for F64x4 {
    type Mask = Bool4;

    #[inline(always)]
    fn constant(x: f32) -> Self {
        Self([f64::from(x); 4])
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(lanes(|k| self.0[k].min(other.0[k])))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(lanes(|k| self.0[k].max(other.0[k])))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn less(self, other: Self) -> Bool4 {
        Bool4(lanes(|k| self.0[k] < other.0[k]))
    }
    #[inline(always)]
    fn equal(self, other: Self) -> Bool4 {
        Bool4(lanes(|k| self.0[k] == other.0[k]))
    }
    #[inline(always)]
    fn pick(no: Self, yes: Self, mask: Bool4) -> Self {
        Self(lanes(|k| if mask.0[k] { yes.0[k] } else { no.0[k] }))
    }
}

impl Double for F64x4 {
    type Single = Vec4;

    #[inline(always)]
    fn widen(x: Vec4) -> Self {
        Self(x.as_dvec4().to_array())
    }
    #[inline(always)]
    fn narrow(self) -> Vec4 {
        Vec4::from_array(self.0.map(Double::narrow))
    }
}
