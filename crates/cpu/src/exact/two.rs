//! Twin of `shaders/exact/number/pair.wgsl`: numbers of twice the width, as unevaluated sums of two.
//!
//! Sums and products are error-free transforms (Knuth's two-sum; Dekker's two-product, by splitting) followed by a
//! renormalisation. A result is off by less than `2^-100` relative (Joldes, Muller and Popescu 2017 prove `3 u^2` and `7 u^2`
//! for such sums and products, `u = 2^-53`; quotient and square root below add one Newton step, under `16 u^2`).

use std::ops::{Add, Div, Mul, Sub};

use crate::number::Number;

/// What one operation is off by at most, relative to its result.
pub(crate) const ROUNDOFF: f32 = f32::from_bits((127 - 100) << 23);

/// `high + low` with `|low|` at most half an ULP of `high`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) struct Two {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl From<f64> for Two {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// `a + b` and what rounding lost.
fn two_sum(a: f64, b: f64) -> Two {
    let high = a + b;
    let part = high - a;
    Two { high, low: (a - (high - part)) + (b - part) }
}

/// The same where `|a| >= |b|` or `a = 0`.
fn quick_two_sum(a: f64, b: f64) -> Two {
    let high = a + b;
    Two { high, low: b - (high - a) }
}

/// A number as a sum of two of at most 26 bits.
fn split(a: f64) -> Two {
    let scaled = 134_217_729.0 * a; // 2^27 + 1
    let high = scaled - (scaled - a);
    Two { high, low: a - high }
}

/// `a b` and what rounding lost.
fn two_product(a: f64, b: f64) -> Two {
    let high = a * b;
    let (x, y) = (split(a), split(b));
    let low = ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low;
    Two { high, low }
}

impl Add for Two {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = two_sum(self.high, other.high);
        let rest = two_sum(self.low, other.low);
        let sum = quick_two_sum(sum.high, sum.low + rest.high);
        quick_two_sum(sum.high, sum.low + rest.low)
    }
}

impl Sub for Two {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl Mul for Two {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        quick_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Two {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = Self::from(self.high / other.high);
        let rest = self - first * other;
        let second = Self::from(rest.high / other.high);
        let rest = rest - second * other;
        first + second + Self::from(rest.high / other.high)
    }
}

impl Number for Two {
    type Mask = bool;

    fn constant(x: f32) -> Self {
        f64::from(x).into()
    }
    fn abs(self) -> Self {
        if self.high < 0.0 { Self { high: -self.high, low: -self.low } } else { self }
    }
    fn min(self, other: Self) -> Self {
        if other.less(self) { other } else { self }
    }
    fn max(self, other: Self) -> Self {
        if self.less(other) { other } else { self }
    }
    fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::from(0.0);
        }
        let first = Self::from(self.high.sqrt());
        let second = (self - first * first).high / (2.0 * first.high);
        let root = first + Self::from(second);
        root + Self::from((self - root * root).high / (2.0 * first.high))
    }
    fn less(self, other: Self) -> bool {
        self.high < other.high || (self.high == other.high && self.low < other.low)
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}
