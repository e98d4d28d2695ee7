//! Twin of `shaders/exact/number/pair.wgsl`: numbers of twice the width, as unevaluated sums of two.
//!
//! Sums and products are error-free transforms (Knuth's two-sum; Dekker's two-product, by splitting) followed by a
//! renormalisation. A result is off by less than `2^-100` relative (Joldes, Muller and Popescu 2017 prove `3 u^2` and `7 u^2`
//! for such sums and products, `u = 2^-53`; quotient and square root below add one Newton step, under `16 u^2`).

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::Vec4;

use super::Number;

/// A half of a number, or of several abreast.
pub(crate) trait Part: Number + Neg<Output = Self> {
    /// `2^s + 1` with `s` half the bits: it cuts a part in two.
    const SPLITTER: Self;
}

impl Part for f64 {
    const SPLITTER: Self = 134_217_729.0; // 2^27 + 1
}
impl Part for f32 {
    const SPLITTER: Self = 4097.0; // 2^12 + 1
}
impl Part for Vec4 {
    const SPLITTER: Self = Self::splat(f32::SPLITTER);
}

/// `high + low` with `|low|` at most half an ULP of `high`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) struct Two<P = f64> {
    pub(crate) high: P,
    pub(crate) low: P,
}

impl<P: Part> From<P> for Two<P> {
    #[inline(always)]
    fn from(high: P) -> Self {
        Self { high, low: P::constant(0.0) }
    }
}

/// `a + b` and what rounding lost.
#[inline(always)]
pub(crate) fn two_sum<P: Part>(a: P, b: P) -> Two<P> {
    let high = a + b;
    let part = high - a;
    Two { high, low: (a - (high - part)) + (b - part) }
}

/// `a + b` and what rounding lost, where `|a| >= |b|` or `a = 0`.
#[inline(always)]
fn quick_two_sum<P: Part>(a: P, b: P) -> Two<P> {
    let high = a + b;
    Two { high, low: b - (high - a) }
}

/// A number as a sum of two of half its bits.
#[inline(always)]
fn split<P: Part>(a: P) -> Two<P> {
    let scaled = P::SPLITTER * a;
    let high = scaled - (scaled - a);
    Two { high, low: a - high }
}

/// `a b` and what rounding lost.
#[inline(always)]
pub(crate) fn two_product<P: Part>(a: P, b: P) -> Two<P> {
    let high = a * b;
    let (x, y) = (split(a), split(b));
    let low = ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low;
    Two { high, low }
}

impl<P: Part> Add for Two<P> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let sum = two_sum(self.high, other.high);
        let rest = two_sum(self.low, other.low);
        let sum = quick_two_sum(sum.high, sum.low + rest.high);
        quick_two_sum(sum.high, sum.low + rest.low)
    }
}

impl<P: Part> Sub for Two<P> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<P: Part> Mul for Two<P> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        quick_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl<P: Part> Div for Two<P> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = Self::from(self.high / other.high);
        let rest = self - first * other;
        let second = Self::from(rest.high / other.high);
        let rest = rest - second * other;
        first + second + Self::from(rest.high / other.high)
    }
}

impl<P: Part> Neg for Two<P> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl<P: Part> Number for Two<P> {
    type Mask = P::Mask;

    #[inline(always)]
    fn constant(x: f32) -> Self {
        P::constant(x).into()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::pick(self, -self, self.high.less(P::constant(0.0)))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::pick(self, other, other.less(self))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::pick(self, other, self.less(other))
    }
    fn sqrt(self) -> Self {
        let twice = |x: P| x + x;
        let first = Self::from(self.high.sqrt());
        let second = (self - first * first).high / twice(first.high);
        let root = first + Self::from(second);
        let root = root + Self::from((self - root * root).high / twice(first.high));
        Self::pick(Self::constant(0.0), root, P::constant(0.0).less(self.high))
    }
    #[inline(always)]
    fn less(self, other: Self) -> P::Mask {
        self.high.less(other.high) | (self.high.equal(other.high) & self.low.less(other.low))
    }
    #[inline(always)]
    fn equal(self, other: Self) -> P::Mask {
        self.high.equal(other.high) & self.low.equal(other.low)
    }
    #[inline(always)]
    fn pick(no: Self, yes: Self, mask: P::Mask) -> Self {
        Self { high: P::pick(no.high, yes.high, mask), low: P::pick(no.low, yes.low, mask) }
    }
}
