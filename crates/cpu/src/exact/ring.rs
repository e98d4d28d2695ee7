//! Whole numbers to decide exactly with: 128 bits while they suffice, then as many as it takes.

use std::cmp::Ordering;

use num_bigint::BigInt;

/// Whole numbers without a rounding. An operation may give up; what follows from that has no sign.
pub(crate) trait Ring: Clone {
    /// `mantissa 2^shift`.
    fn new(mantissa: i64, shift: u32) -> Self;
    fn add(&self, other: &Self) -> Self;
    fn sub(&self, other: &Self) -> Self;
    fn mul(&self, other: &Self) -> Self;
    /// `self 2^shift`.
    fn shifted(&self, shift: u32) -> Self;
    /// Its comparison with zero; `None` where an operation gave up.
    fn sign(&self) -> Option<Ordering>;
    /// How `a b` compares with `c d`.
    fn compare_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Option<Ordering>;

    fn negated(&self) -> Self {
        Self::new(0, 0).sub(self)
    }
    fn compare(&self, other: &Self) -> Option<Ordering> {
        self.sub(other).sign()
    }
}

/// 128 bits; `None` where they did not suffice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Narrow(Option<i128>);

impl Narrow {
    fn both(self, other: Self, f: impl Fn(i128, i128) -> Option<i128>) -> Self {
        Self(self.0.zip(other.0).and_then(|(a, b)| f(a, b)))
    }
}

impl Ring for Narrow {
    fn new(mantissa: i64, shift: u32) -> Self {
        Self(Some(i128::from(mantissa))).shifted(shift)
    }
    fn add(&self, other: &Self) -> Self {
        self.both(*other, i128::checked_add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.both(*other, i128::checked_sub)
    }
    fn mul(&self, other: &Self) -> Self {
        self.both(*other, i128::checked_mul)
    }
    fn shifted(&self, shift: u32) -> Self {
        Self(self.0.and_then(|x| {
            let room = x.unsigned_abs().leading_zeros();
            (x == 0 || shift + 1 < room).then(|| if x == 0 { 0 } else { x << shift })
        }))
    }
    fn sign(&self) -> Option<Ordering> {
        self.0.map(|x| x.cmp(&0))
    }
    fn compare_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Option<Ordering> {
        let product = |x: i128, y: i128| (x.signum() * y.signum(), full_product(x.unsigned_abs(), y.unsigned_abs()));
        let ((s, x), (z, y)) = (product(a.0?, b.0?), product(c.0?, d.0?));
        Some(s.cmp(&z).then_with(|| if s < 0 { y.cmp(&x) } else { x.cmp(&y) }))
    }
}

/// All 256 bits of a product, the upper half first.
fn full_product(a: u128, b: u128) -> [u128; 2] {
    let halves = |x: u128| [x >> 64, x & u128::from(u64::MAX)];
    let ([a1, a0], [b1, b0]) = (halves(a), halves(b));
    let [carry, low] = halves(a0 * b0);
    let [x1, x0] = halves(a1 * b0 + carry);
    let [y1, y0] = halves(a0 * b1 + x0);
    [a1 * b1 + x1 + y1, (y0 << 64) | low]
}

impl Ring for BigInt {
    fn new(mantissa: i64, shift: u32) -> Self {
        Self::from(mantissa) << shift
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn shifted(&self, shift: u32) -> Self {
        self << shift
    }
    fn sign(&self) -> Option<Ordering> {
        Some(self.cmp(&Self::ZERO))
    }
    fn compare_products(a: &Self, b: &Self, c: &Self, d: &Self) -> Option<Ordering> {
        Some((a * b).cmp(&(c * d)))
    }
}
