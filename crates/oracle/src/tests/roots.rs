//! Exact numbers against integer square roots, and rounding against its definition.

use std::cmp::Ordering;

use dashu_base::{Sign, SquareRoot, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use super::Random;
use crate::Root;

fn ratio(n: i64, d: u64) -> RBig {
    RBig::from_parts(IBig::from(n), UBig::from(d))
}

fn root(p: RBig, sign: Sign, d: RBig) -> Root {
    Root::new(p, sign, d)
}

/// `floor(2^200 (p + s sqrt(D)))` or one less, by integer arithmetic alone.
fn scaled(p: &RBig, sign: Sign, d: &RBig) -> IBig {
    let one = UBig::ONE << 400;
    let root = IBig::from(
        (d.numerator().clone() * IBig::from(one) / IBig::from(d.denominator().clone())).unsigned_abs().sqrt(),
    );
    let p = (p * RBig::from(UBig::ONE << 200)).floor();
    if sign == Sign::Positive { p + root } else { p - root - IBig::ONE }
}

#[test]
fn roots_are_ordered_as_their_digits_are() {
    let mut random = Random::new(0x5eed_0001);
    let mut draw = || {
        let sign = if random.below(2) == 0 { Sign::Positive } else { Sign::Negative };
        let p = ratio(i64::from(random.below(13)) - 6, u64::from(random.below(2) + 1));
        let d = ratio(i64::from(random.below(12)), 1);
        // A square half of the times: the same number has many forms.
        let d = if random.below(2) == 0 { d.sqr() } else { d };
        (p, sign, d)
    };
    let (mut equal, mut different) = (0, 0);
    for _ in 0..20_000 {
        let [(p, s, d), (q, r, e)] = [draw(), draw()];
        let (x, y) = (scaled(&p, s, &d), scaled(&q, r, &e));
        let order = root(p, s, d).cmp(&root(q, r, e));
        // Different numbers of this kind differ within far fewer than 200 bits.
        if (&x - &y).unsigned_abs() <= UBig::from(4_u8) {
            assert_eq!(order, Ordering::Equal);
            equal += 1;
        } else {
            assert_eq!(order, x.cmp(&y));
            different += 1;
        }
    }
    println!("{equal} equal, {different} different");
    assert!(equal > 50 && different > 10_000);
}

#[test]
fn a_root_is_told_from_a_rational_next_to_it() {
    let two = root(RBig::ZERO, Sign::Positive, RBig::from(2));
    // Convergents of sqrt(2) lie on alternating sides of it.
    let (mut n, mut d) = (1_i64, 1_u64);
    for i in 0..40 {
        let expected = if i % 2 == 0 { Ordering::Greater } else { Ordering::Less };
        assert_eq!(two.cmp_rational(&ratio(n, d)), expected, "{n}/{d}");
        (n, d) = (n + 2 * i64::try_from(d).unwrap(), d + u64::try_from(n).unwrap());
    }
    let three = root(RBig::from(5), Sign::Negative, RBig::from(4));
    assert_eq!(three, Root::from(RBig::from(3)));
    assert_eq!(three.cmp_rational(&RBig::from(3)), Ordering::Equal);
    assert_eq!(root(RBig::from(-3), Sign::Positive, RBig::from(9)).to_f32().to_bits(), 0);
}

/// `x` is the nearest to the number: the number is between the midpoints around `x`, and on one only if `x` is even.
fn assert_nearest(number: &Root, x: f32) {
    let value = |x: f32| if x.is_infinite() { f64::from(x.signum()) * 2.0_f64.powi(128) } else { f64::from(x) };
    for (other, side) in [(x.next_up(), Ordering::Less), (x.next_down(), Ordering::Greater)] {
        if other == x {
            // Nothing lies beyond infinity.
            continue;
        }
        let midpoint = RBig::try_from(0.5 * (value(x) + value(other))).unwrap();
        let order = number.cmp_rational(&midpoint);
        assert!(order == side || (order == Ordering::Equal && x.to_bits().is_multiple_of(2)), "{number:?} as {x:e}");
    }
}

#[test]
fn rounding_is_to_the_nearest_even() {
    let mut random = Random::new(0x5eed_0002);
    for _ in 0..5_000 {
        let power = |k: u32| {
            if k < 160 {
                RBig::from(UBig::ONE << k as usize)
            } else {
                ratio(1, 1) / RBig::from(UBig::ONE << (k - 160) as usize)
            }
        };
        let p = ratio(i64::from(random.below(2000)) - 1000, 7) * power(random.below(320));
        let d = ratio(i64::from(random.below(2000)), 3) * power(random.below(320));
        let x = root(p, if random.below(2) == 0 { Sign::Positive } else { Sign::Negative }, d);
        assert_nearest(&x, x.to_f32());
    }
    // Ties, exactly and one part in 2^300 off; the ends of the range.
    let tiny = RBig::ONE / RBig::from(UBig::ONE << 500);
    for _ in 0..2_000 {
        let k = match random.below(4) {
            0 => random.below(64),
            1 => 0x7f7f_ffff - random.below(64),
            _ => random.below(0x7f7f_ffff),
        };
        let (x, up) = (f32::from_bits(k), f32::from_bits(k + 1));
        let up = if up.is_infinite() { 2.0_f64.powi(128) } else { f64::from(up) };
        let tie = RBig::try_from(0.5 * (f64::from(x) + up)).unwrap();
        let [below, at, above] = [&tie - &tiny, tie.clone(), &tie + &tiny].map(|n| Root::from(n).to_f32().to_bits());
        assert_eq!([below, at, above], [k, k + k % 2, k + 1]);
        let negative = Root::from(-tie).to_f32();
        assert_eq!(negative.to_bits(), if k + k % 2 == 0 { 0 } else { (k + k % 2) | 1 << 31 });
    }
}

#[test]
fn the_guess_is_close_where_digits_cancel() {
    // 10^6 - sqrt(10^12 - 1): the digits of a ground sphere's near root.
    let x = root(RBig::from(1_000_000), Sign::Negative, RBig::from(999_999_999_999_i64));
    assert!((x.to_f64() / 5.000_000_000_001_25e-7 - 1.0).abs() < 1e-12, "{:e}", x.to_f64());
}
