//! The leading digits of an exact number, in any base.

use dashu_base::UnsignedAbs as _;
use dashu_int::UBig;
use dashu_ratio::RBig;

use crate::Root;

/// The positive number `x` rounded to `count` digits in a base, ties to even: the digits as one whole number, and the
/// exponent of the first of them.
pub(super) fn leading(x: &Root, base: u8, count: usize) -> (UBig, isize) {
    let power = |n: isize| RBig::from(base).pow(n);
    let count = count.cast_signed();
    let mut exponent = guess(x, base);
    loop {
        let scaled = x.times(&power(count - 1 - exponent));
        let whole = scaled.floor().unsigned_abs();
        let length = if whole.is_zero() { 0 } else { whole.ilog(&UBig::from(base)).cast_signed() + 1 };
        if length == count {
            let digits = round(whole, &scaled);
            // Digits that are all the last of the base round to a one and zeros.
            return if RBig::from(digits.clone()) == power(count) {
                (digits / UBig::from(base), exponent + 1)
            } else {
                (digits, exponent)
            };
        }
        // The length of a whole part tells the exponent; where there is none, the exponent is lower by that many at least.
        exponent += length - count;
    }
}

/// The whole number nearest to `x`, whose whole part is given; of two the even one.
fn round(whole: UBig, x: &Root) -> UBig {
    let half = (RBig::from(whole.clone()) * RBig::from(2) + RBig::ONE) / RBig::from(2);
    let order = x.cmp_rational(&half);
    let odd = &whole % 2_u8 == 1;
    if order.is_gt() || (order.is_eq() && odd) { whole + UBig::ONE } else { whole }
}

/// About the exponent; any is right, but a far one takes longer.
#[expect(clippy::cast_possible_truncation, reason = "a guess, and a logarithm of an f64 is small")]
fn guess(x: &Root, base: u8) -> isize {
    let exponent = (x.to_f64().ln() / f64::from(base).ln()).floor();
    if exponent.is_finite() { exponent as isize } else { 0 }
}
