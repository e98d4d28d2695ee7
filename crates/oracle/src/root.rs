use std::cmp::Ordering;

use dashu_base::{Sign, SquareRoot as _};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// The exact real number `p + s sqrt(D)`: `p` and `D >= 0` rational, `s` one of `-1, 1`.
///
/// The parameter of every hit is one: on a triangle with `D = 0`, on a sphere a root of a quadratic. Comparisons are
/// exact: they square until no root is left, and never round.
#[derive(Clone, Debug)]
pub struct Root {
    rational: RBig,
    /// The sign of the root; [`Sign::Positive`] where the radicand is zero.
    sign: Sign,
    radicand: RBig,
}

impl Root {
    /// The number `rational + sqrt(radicand)`, or `rational - sqrt(radicand)` for a negative `sign`.
    ///
    /// # Panics
    /// When `radicand` is negative.
    #[must_use]
    pub fn new(rational: RBig, sign: Sign, radicand: RBig) -> Self {
        assert!(radicand.sign() == Sign::Positive, "the square root of a negative number");
        let sign = if radicand.is_zero() { Sign::Positive } else { sign };
        Self { rational, sign, radicand }
    }

    /// How it compares with a rational number.
    #[must_use]
    pub fn cmp_rational(&self, other: &RBig) -> Ordering {
        sign_of(&(&self.rational - other), self.sign, &self.radicand)
    }

    /// The nearest `f32`, ties to even; infinite beyond the largest by the same rule. Never a negative zero.
    #[must_use]
    pub fn to_f32(&self) -> f32 {
        if self.cmp_rational(&RBig::ZERO) == Ordering::Less {
            // Where a negative number rounds to zero, `0.0 -` keeps the zero positive.
            0.0 - magnitude_to_f32(&-self)
        } else {
            magnitude_to_f32(self)
        }
    }

    /// A close `f64`: off by a few units in the last place, without cancellation. Nothing is decided by it.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let float = |x: &RBig| x.to_f64().value();
        let (p, root) = (float(&self.rational), self.sign * float(&self.radicand).sqrt());
        if root == 0.0 || p == 0.0 || (p < 0.0) == (root < 0.0) {
            p + root
        } else {
            // Signs differ: (p + x) = (p^2 - x^2) / (p - x), whose numerator is rational.
            float(&(self.rational.sqr() - &self.radicand)) / (p - root)
        }
    }

    /// This number times `by`, which is above zero.
    pub(crate) fn times(&self, by: &RBig) -> Self {
        Self { rational: &self.rational * by, sign: self.sign, radicand: &self.radicand * by.sqr() }
    }

    /// This number less `other`.
    pub(crate) fn minus(&self, other: &RBig) -> Self {
        Self { rational: &self.rational - other, ..self.clone() }
    }

    /// The magnitude.
    pub(crate) fn abs(&self) -> Self {
        if self.cmp_rational(&RBig::ZERO) == Ordering::Less { -self } else { self.clone() }
    }

    /// The largest whole number that is not above it.
    pub(crate) fn floor(&self) -> IBig {
        // In whole numbers it is (m + s sqrt(w)) / n, and floor((m + z) / n) = floor((m + floor(z)) / n) for any real z.
        let (p, d) = (&self.rational, &self.radicand);
        let n = p.denominator() * d.denominator();
        let w = UBig::try_from(d.numerator().clone()).expect("it is not negative") * &n * p.denominator();
        let below = w.sqrt();
        let root = match self.sign {
            Sign::Positive => IBig::from(below),
            Sign::Negative if below.sqr() == w => -IBig::from(below),
            Sign::Negative => -IBig::from(below + UBig::ONE),
        };
        RBig::from_parts(p.numerator() * d.denominator() + root, n).floor()
    }

    /// The rational part `p` and the radicand `D`.
    #[must_use]
    pub fn parts(&self) -> (&RBig, &RBig) {
        (&self.rational, &self.radicand)
    }
}

impl From<RBig> for Root {
    fn from(rational: RBig) -> Self {
        Self { rational, sign: Sign::Positive, radicand: RBig::ZERO }
    }
}

impl std::ops::Neg for &Root {
    type Output = Root;

    fn neg(self) -> Root {
        Root::new(-self.rational.clone(), -self.sign, self.radicand.clone())
    }
}

impl Ord for Root {
    fn cmp(&self, other: &Self) -> Ordering {
        // The sign of a + x with a rational and x = s1 sqrt(D1) - s2 sqrt(D2).
        let a = &self.rational - &other.rational;
        let (d1, d2) = (&self.radicand, &other.radicand);
        let x_sign = match (self.sign, other.sign) {
            (Sign::Positive, Sign::Positive) => d1.cmp(d2),
            (Sign::Negative, Sign::Negative) => d2.cmp(d1),
            // The roots add up; a zero radicand is positive, so the negative one is not zero.
            (Sign::Positive, Sign::Negative) => Ordering::Greater,
            (Sign::Negative, Sign::Positive) => Ordering::Less,
        };
        let a_sign = a.cmp(&RBig::ZERO);
        if x_sign == Ordering::Equal || a_sign == x_sign {
            return a_sign;
        }
        if a_sign == Ordering::Equal {
            return x_sign;
        }
        // Opposite signs: the larger square wins, and x^2 = D1 + D2 - 2 s1 s2 sqrt(D1 D2).
        let squares = sign_of(&(a.sqr() - d1 - d2), self.sign * other.sign, &(RBig::from(4) * d1 * d2));
        if a_sign == Ordering::Greater { squares } else { squares.reverse() }
    }
}

impl PartialOrd for Root {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Root {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Root {}

/// The sign of `a + s sqrt(b)`, as its comparison with zero.
fn sign_of(a: &RBig, s: Sign, b: &RBig) -> Ordering {
    let root = if b.is_zero() {
        Ordering::Equal
    } else if s == Sign::Positive {
        Ordering::Greater
    } else {
        Ordering::Less
    };
    match (a.cmp(&RBig::ZERO), root) {
        (rational, Ordering::Equal) => rational,
        (Ordering::Equal, root) => root,
        (rational, root) if rational == root => root,
        (Ordering::Greater, _) => a.sqr().cmp(b),
        (_, _) => b.cmp(&a.sqr()),
    }
}

const INFINITE: u32 = f32::INFINITY.to_bits();

/// [`Root::to_f32`] of a number that is not negative.
///
/// Positive floats are ordered as their bits are. The answer is the lowest `k` whose number reaches up to `x`: that
/// is, `x` lies below the midpoint of the numbers `k` and `k + 1`, or on it where `k` is even. It is galloped to from
/// a guess, then bisected, so that a bad guess costs time only.
fn magnitude_to_f32(x: &Root) -> f32 {
    let reaches = |k: u32| {
        k == INFINITE || {
            let order = x.cmp_rational(&upper_midpoint(k));
            order == Ordering::Less || (order == Ordering::Equal && k.is_multiple_of(2))
        }
    };
    #[expect(clippy::cast_possible_truncation, reason = "a guess")]
    let guess = (x.to_f64().abs() as f32).to_bits().min(INFINITE);
    let (mut low, mut step) = (guess, 1);
    while low > 0 && reaches(low - 1) {
        low = low.saturating_sub(step);
        step *= 2;
    }
    let (mut high, mut step) = (guess, 1);
    while !reaches(high) {
        high = (high + step).min(INFINITE);
        step *= 2;
    }
    while low < high {
        let middle = low + (high - low) / 2;
        if reaches(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    f32::from_bits(low)
}

/// The midpoint of the numbers with bits `k` and `k + 1`, where infinity stands for 2^128. Exact: `f64` has the bits.
fn upper_midpoint(k: u32) -> RBig {
    let value = |k: u32| if k == INFINITE { 2.0_f64.powi(128) } else { f64::from(f32::from_bits(k)) };
    RBig::try_from(0.5 * (value(k) + value(k + 1))).expect("two finite numbers are far from overflow")
}
