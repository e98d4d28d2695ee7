//! Exact arithmetic in sums of `f64`: expansions (Shewchuk 1997, building on Dekker 1971 and Knuth).
//!
//! A number is a sum of `f64` that do not overlap, smallest first. Sums and products of such sums are exact as long as nothing
//! over- or underflows. So each expansion carries a power of two of which all its parts are multiples, and one that it stays
//! below, so that no part exceeds that either:
//!
//! * Sums of multiples of a unit of at least `2^-1074` never underflow.
//! * The product of two parts, Dekker's partial products and the error are multiples of the product of the units: the error,
//!   of at most 53 bits, is representable while that is at least `2^-1074`.
//! * Where operands and result stay below `2^990`, splitting a part times `2^27 + 1`, and adding up to `2^33` terms that are
//!   each no larger than `2^990`, stay below `2^1024`.
//!
//! Where a bound is passed the number is unsound, as is all that is made of it, and has no sign.
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// The smallest unit, and the largest power of two that a number may reach so that splitting it does not overflow.
const LOWEST: i32 = -1074;
const HIGHEST: i32 = 990;

/// An exact number.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    /// None of them zero; none overlaps another.
    parts: Vec<f64>,
    /// All parts are multiples of two to this.
    unit: i32,
    /// The number is below two to this.
    top: i32,
    sound: bool,
}

impl From<f64> for Expansion {
    fn from(x: f64) -> Self {
        if x == 0.0 {
            return Self { parts: Vec::new(), unit: HIGHEST, top: LOWEST, sound: true };
        }
        let bits = x.to_bits();
        let field = i32::try_from(bits >> 52 & 0x7ff).expect("11 bits");
        let (mantissa, exponent) = match field {
            0 => (bits << 12 >> 12, LOWEST),
            _ => (bits << 12 >> 12 | 1 << 52, field - 1075),
        };
        let (low, length) = (mantissa.trailing_zeros(), 64 - mantissa.leading_zeros());
        let [low, length] = [low, length].map(|n| i32::try_from(n).expect("at most 64"));
        Self { parts: vec![x], unit: exponent + low, top: exponent + length, sound: x.is_finite() }
    }
}

impl From<f32> for Expansion {
    fn from(x: f32) -> Self {
        f64::from(x).into()
    }
}

/// `a + b` and what rounding lost (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// `a b` and what rounding lost (Dekker, Veltkamp).
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let split = |x: f64| {
        let scaled = 134_217_729.0 * x; // 2^27 + 1
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let (product, (a1, a2), (b1, b2)) = (a * b, split(a), split(b));
    (product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2))
}

impl Expansion {
    fn with(parts: Vec<f64>, unit: i32, top: i32, sound: bool) -> Self {
        Self { parts, unit, top, sound: sound && unit >= LOWEST && top <= HIGHEST }
    }

    pub(super) fn square(&self) -> Self {
        self * self
    }

    /// The sign; `None` where the number may have lost bits.
    pub(super) fn sign(&self) -> Option<Ordering> {
        let largest = self.parts.last().copied().unwrap_or(0.0);
        if self.sound { largest.partial_cmp(&0.0) } else { None }
    }

    /// A close `f64`: the parts do not cancel.
    pub(super) fn estimate(&self) -> f64 {
        self.parts.iter().sum()
    }
}

/// Adds one `f64` to parts (Shewchuk's grow-expansion, zeros dropped).
fn grow(parts: &mut Vec<f64>, x: f64) {
    let mut carry = x;
    let mut kept = 0;
    for i in 0..parts.len() {
        let (sum, error) = two_sum(carry, parts[i]);
        carry = sum;
        if error != 0.0 {
            parts[kept] = error;
            kept += 1;
        }
    }
    parts.truncate(kept);
    if carry != 0.0 {
        parts.push(carry);
    }
}

impl Add for &Expansion {
    type Output = Expansion;

    fn add(self, other: Self) -> Expansion {
        let mut parts = self.parts.clone();
        other.parts.iter().for_each(|&x| grow(&mut parts, x));
        let (unit, top) = (self.unit.min(other.unit), self.top.max(other.top) + 1);
        Expansion::with(parts, unit, top, self.sound && other.sound)
    }
}

impl Neg for &Expansion {
    type Output = Expansion;

    fn neg(self) -> Expansion {
        Expansion { parts: self.parts.iter().map(|x| -x).collect(), ..*self }
    }
}

impl Sub for &Expansion {
    type Output = Expansion;

    fn sub(self, other: Self) -> Expansion {
        self + &-other
    }
}

impl Mul for &Expansion {
    type Output = Expansion;

    fn mul(self, other: Self) -> Expansion {
        if self.parts.is_empty() || other.parts.is_empty() {
            return Expansion { sound: self.sound && other.sound, ..Expansion::from(0.0) };
        }
        let mut parts = Vec::new();
        for &a in &self.parts {
            for &b in &other.parts {
                let (product, error) = two_product(a, b);
                grow(&mut parts, error);
                grow(&mut parts, product);
            }
        }
        Expansion::with(parts, self.unit + other.unit, self.top + other.top, self.sound && other.sound)
    }
}

/// Three exact numbers.
pub(super) type Vector = [Expansion; 3];

pub(super) fn vector(p: glam::Vec3) -> Vector {
    p.to_array().map(Expansion::from)
}

pub(super) fn minus([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [a - x, b - y, c - z]
}

pub(super) fn dot([a, b, c]: &Vector, [x, y, z]: &Vector) -> Expansion {
    &(&(a * x) + &(b * y)) + &(c * z)
}

pub(super) fn cross([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [&(b * z) - &(c * y), &(c * x) - &(a * z), &(a * y) - &(b * x)]
}

#[cfg(test)]
mod tests {
    use dashu_ratio::RBig;
    use proptest::prelude::*;

    use super::*;

    fn exact(x: &Expansion) -> RBig {
        x.parts.iter().fold(RBig::ZERO, |sum, &part| sum + RBig::try_from(part).expect("finite"))
    }

    /// Any number, or one next to a power of two near 1, so that sums cancel and products end in ties.
    fn single() -> impl Strategy<Value = f32> {
        let all = any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |x| x.is_finite());
        let near = (124_u32..131, 0_u32..5, any::<bool>())
            .prop_map(|(e, ulps, minus)| f32::from_bits(u32::from(minus) << 31 | ((e << 23) + ulps - 2)));
        prop_oneof![all, near]
    }

    /// What the module says of parts, unit and top.
    fn is_regular(x: &Expansion) -> bool {
        let below = |y: RBig, n: i32| y.sqr() < RBig::from(4).pow(n as isize);
        let apart = |i: usize| {
            let (part, smaller) =
                (Expansion::from(x.parts[i]), Expansion { parts: x.parts[..i].to_vec(), ..x.clone() });
            part.parts.len() == 1 && part.unit >= x.unit && below(exact(&smaller), part.unit)
        };
        (0..x.parts.len()).all(apart) && below(exact(x), x.top)
    }

    proptest! {
        #[test]
        fn sums_and_products_are_exact(x in prop::array::uniform5(single())) {
            let [a, b, c, d, e] = x.map(|x| (Expansion::from(x), RBig::try_from(x).expect("finite")));
            // Degree 4, with cancellation.
            let product = &(&(&a.0 * &b.0) - &(&c.0 * &d.0)) * &(&(&a.0 * &e.0) + &(&c.0 * &b.0));
            let right = (&a.1 * &b.1 - &c.1 * &d.1) * (&a.1 * &e.1 + &c.1 * &b.1);
            prop_assert!(product.sound);
            prop_assert_eq!(exact(&product), right.clone());
            prop_assert_eq!(product.sign(), Some(right.cmp(&RBig::ZERO)));
            let zero = &(&product - &product) + &(&a.0 - &a.0);
            prop_assert_eq!(zero.sign(), Some(Ordering::Equal));
            let square = product.square();
            if square.sound {
                prop_assert_eq!(exact(&square), right.sqr());
            }
            for x in [product, zero, square] {
                prop_assert!(!x.sound || is_regular(&x), "{:?}", x);
            }
        }
    }

    #[test]
    fn what_may_have_underflowed_or_overflowed_has_no_sign() {
        let tiny = Expansion::from(f32::from_bits(1));
        let seventh = (0..6).fold(tiny.clone(), |x, _| &x * &tiny);
        assert_eq!(seventh.sign(), Some(Ordering::Greater), "2^-1043");
        assert_eq!((&seventh * &tiny).sign(), None, "2^-1192");
        assert_eq!((&(&seventh * &tiny) + &Expansion::from(1.0_f64)).sign(), None, "it stays so");
        let huge = Expansion::from(f32::MAX);
        let seventh = (0..6).fold(huge.clone(), |x, _| &x * &huge);
        assert_eq!(seventh.sign(), Some(Ordering::Greater), "2^896");
        assert_eq!((&seventh * &huge).sign(), None, "2^1024");
    }

    #[test]
    fn units_and_tops() {
        for (x, unit, top) in [(1.0_f64, 0, 1), (6.0, 1, 3), (-0.75, -2, 0), (f64::from_bits(3), -1074, -1072)] {
            let e = Expansion::from(x);
            assert_eq!((e.unit, e.top), (unit, top), "{x:e}");
        }
    }
}
