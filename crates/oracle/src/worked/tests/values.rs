//! Values as digits, against known ones and against the standard library's.

use dashu_base::Sign;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use rayproof_scene::random::Random;

use super::super::Value;
use crate::Root;

fn ratio(n: i64, d: u64) -> RBig {
    RBig::from_parts(IBig::from(n), UBig::from(d))
}

fn root(p: RBig, sign: Sign, d: RBig) -> Value {
    Value::Exact(Root::new(p, sign, d))
}

fn exact(p: RBig) -> Value {
    Value::Exact(p.into())
}

#[test]
fn whole_parts_lie_at_or_below() {
    let floor = |p: RBig, sign, d: RBig| Root::new(p, sign, d).floor();
    let (half, plus, minus) = (|| ratio(1, 2), Sign::Positive, Sign::Negative);
    assert_eq!(floor(RBig::from(3), minus, RBig::from(4)), IBig::from(1), "a square");
    assert_eq!(floor(RBig::from(3), minus, RBig::from(5)), IBig::from(0));
    assert_eq!(floor(half(), minus, ratio(9, 4)), IBig::from(-1));
    assert_eq!(floor(half(), minus, ratio(10, 4)), IBig::from(-2));
    assert_eq!(floor(half(), plus, ratio(9, 4)), IBig::from(2));
    assert_eq!(floor(half(), plus, ratio(8, 4)), IBig::from(1));
}

#[test]
fn decimals_of_known_numbers() {
    assert_eq!(Value::F32(0.1).decimal(20), "1.0000000149011611938e-1");
    assert_eq!(Value::F64(0.1).decimal(20), "1.0000000000000000555e-1");
    let two = || RBig::from(2);
    assert_eq!(root(RBig::ZERO, Sign::Positive, two()).decimal(30), "1.41421356237309504880168872421e0");
    assert_eq!(root(RBig::ZERO, Sign::Negative, two()).decimal(30), "-1.41421356237309504880168872421e0");
    assert_eq!(root(RBig::ONE, Sign::Negative, two()).decimal(20), "-4.1421356237309504880e-1");
    // 10^40 -+ sqrt(10^80 - 1): the difference cancels 80 digits.
    let (large, below) = (RBig::from(10).pow(40), RBig::from(10).pow(80) - RBig::ONE);
    assert_eq!(root(large.clone(), Sign::Negative, below.clone()).decimal(9), "5.00000000e-41");
    assert_eq!(root(large, Sign::Positive, below).decimal(9), "2.00000000e40");
    // A root whose square no f64 holds.
    assert_eq!(root(RBig::ZERO, Sign::Positive, RBig::from(10).pow(401)).decimal(5), "3.1623e200");
    assert_eq!(root(RBig::ZERO, Sign::Negative, RBig::from(10).pow(-401)).decimal(5), "-3.1623e-201");
    assert_eq!(Value::F32(f32::from_bits(1)).decimal(5), "1.4013e-45");
    assert_eq!(Value::F64(f64::from_bits(1)).decimal(5), "4.9407e-324");
    assert_eq!(Value::F64(-f64::MAX).decimal(5), "-1.7977e308");
}

#[test]
fn decimals_round_once_and_carry() {
    assert_eq!(exact(ratio(99_996, 10_000)).decimal(4), "1.000e1");
    assert_eq!(exact(ratio(99_994, 10_000)).decimal(4), "9.999e0");
    assert_eq!(exact(ratio(-999_951, 1_000_000)).decimal(4), "-1.000e0");
    // Ties go to the even digit; an irrational number has none.
    assert_eq!(exact(ratio(25, 10)).decimal(1), "2e0");
    assert_eq!(exact(ratio(35, 10)).decimal(1), "4e0");
    assert_eq!(exact(ratio(95, 10)).decimal(1), "1e1");
    assert_eq!(root(RBig::ZERO, Sign::Positive, ratio(625, 100)).decimal(1), "2e0");
    assert_eq!(root(RBig::ZERO, Sign::Positive, ratio(625_001, 100_000)).decimal(1), "3e0");
    // No digit is less than one.
    assert_eq!(exact(ratio(1, 3)).decimal(0), "3e-1");
}

#[test]
fn decimals_of_zero_and_of_what_is_no_number() {
    let zero = root(RBig::from(-2), Sign::Positive, RBig::from(4));
    assert_eq!([zero, Value::F32(-0.0), Value::F64(0.0)].map(|x| x.decimal(9)), ["0"; 3]);
    let infinite = [Value::F32(f32::INFINITY), Value::F64(f64::NEG_INFINITY), Value::F32(f32::NAN), Value::Absent];
    assert_eq!(infinite.map(|x| x.decimal(9)), ["inf", "-inf", "NaN", ""]);
}

#[test]
#[expect(clippy::cast_possible_truncation, reason = "the low bits are an f32's")]
fn decimals_are_those_of_the_standard_library() {
    let mut random = Random::new(7, 0);
    let mut finite = 0;
    for i in 0..20_000 {
        let digits = 1 + i % 25;
        let (x, y) = (f32::from_bits(random.bits() as u32), f64::from_bits(random.bits()));
        if x.is_finite() && y.is_finite() && x != 0.0 && y != 0.0 {
            assert_eq!(Value::F32(x).decimal(digits), format!("{x:.*e}", digits - 1));
            assert_eq!(Value::F64(y).decimal(digits), format!("{y:.*e}", digits - 1));
            finite += 1;
        }
    }
    assert!(finite > 19_000);
}

#[test]
fn hexadecimal_floats() {
    assert_eq!(Value::F32(-0.1).hex().as_deref(), Some("-0x1.99999ap-4"));
    assert_eq!(Value::F64(-0.1).hex().as_deref(), Some("-0x1.999999999999ap-4"));
    assert_eq!(Value::F64(f64::from_bits(3)).hex().as_deref(), Some("0x1.8p-1073"));
    assert_eq!(Value::F64(f64::INFINITY).hex().as_deref(), Some("inf"));
    assert_eq!((exact(RBig::ONE).hex(), Value::Absent.hex()), (None, None));
}

#[test]
fn digits_agree_from_the_front() {
    let same = |x: Value, y: Value| x.same_digits(&y, 5);
    let third = || exact(ratio(1, 3));
    assert_eq!(same(Value::F64(0.33334), third()), "3.333".len());
    assert_eq!(same(Value::F64(0.34), third()), "3.".len());
    assert_eq!(same(Value::F32(0.333_333_34), third()), "3.3333e-1".len(), "all, the exponent included");
    assert_eq!(same(Value::F64(0.2), third()), 0);
    assert_eq!(same(Value::F64(-0.33333), third()), 0, "another sign");
    assert_eq!(same(Value::F64(3.3333), third()), 0, "another exponent");
    let minus = || exact(ratio(-1, 3));
    assert_eq!(same(Value::F64(-0.333), minus()), "-3.33".len());
    assert_eq!(same(Value::F64(-0.2), minus()), "-".len());
    assert_eq!(same(Value::F64(-0.0), exact(RBig::ZERO)), 1);
    assert_eq!([same(Value::F64(0.0), third()), same(third(), exact(RBig::ZERO))], [0, 0]);
    assert_eq!([same(Value::F32(f32::NAN), third()), same(Value::Absent, third())], [0, 0]);
    assert_eq!(same(Value::F32(f32::INFINITY), Value::F32(f32::INFINITY)), 3);
}

#[test]
fn distances_are_in_the_exact_values_ulp() {
    let one = || exact(RBig::ONE);
    assert_eq!(Value::F32(1.0).ulps_from(&one()), Some(0.0));
    assert_eq!(Value::F32(1.0 + 3.0 * f32::EPSILON).ulps_from(&one()), Some(3.0));
    // The unit is that of the exact value, also where the other lies in another binade.
    assert_eq!(Value::F32(0.75).ulps_from(&one()), Some(0.25 / f64::from(f32::EPSILON)));
    assert_eq!(Value::F64(1.0 - f64::EPSILON).ulps_from(&one()), Some(1.0));
    // The nearest f32 and f64 of 1/3 are off by 1/3 of an ULP: 2^25 / 3 and 2^54 / 3 leave 2/3 and 1/3.
    let third = || exact(ratio(1, 3));
    assert_eq!(Value::F32(1.0 / 3.0).ulps_from(&third()), Some(1.0 / 3.0));
    assert_eq!(Value::F64(1.0 / 3.0).ulps_from(&third()), Some(1.0 / 3.0));
    // Just below 1, but rounded to it, so the unit is that of 1.
    let below = exact(RBig::ONE - RBig::from(2).pow(-26));
    assert_eq!(Value::F32(1.0).ulps_from(&below), Some(0.125));
    // At the bottom the unit is the smallest number.
    let least = f32::from_bits(1);
    assert_eq!(Value::F32(3.0 * least).ulps_from(&exact(RBig::ZERO)), Some(3.0));
    assert_eq!(Value::F32(0.0).ulps_from(&exact(RBig::from(2).pow(-150))), Some(0.5));
    assert_eq!(Value::F32(0.0).ulps_from(&exact(RBig::from(2).pow(-1000))), Some(2.0_f64.powi(-851)));
    // An irrational one, close by: sqrt(2) is 1.41421356237309504880..
    let root = root(RBig::ZERO, Sign::Positive, RBig::from(2));
    let error = Value::F64(std::f64::consts::SQRT_2).ulps_from(&root);
    assert!(error.is_some_and(|error| (error - 0.435_376_185_641_478_3).abs() < 1e-15), "{error:?}");
}

#[test]
fn what_is_not_finite_has_no_distance() {
    let one = exact(RBig::ONE);
    for x in [Value::F32(f32::INFINITY), Value::F64(f64::NAN), Value::Absent, one.clone()] {
        assert_eq!(x.ulps_from(&one), None, "{x:?}");
    }
    assert_eq!(Value::F32(1.0).ulps_from(&Value::Absent), None);
    let large = exact(RBig::from(2).pow(128) - RBig::from(2).pow(102));
    assert_eq!(Value::F32(1.0).ulps_from(&large), None, "it rounds to infinity");
    assert!(Value::F64(1.0).ulps_from(&large).is_some());
    let largest = exact(RBig::try_from(f32::MAX).unwrap());
    assert_eq!(Value::F32(f32::MAX).ulps_from(&largest), Some(0.0));
}
