use dashu_ratio::RBig;
use rayproof_scene::number;

use super::digits::leading;
use crate::{Root, rational::Number};

/// What a precision makes of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Nothing: the precision does not compute it.
    Absent,
    /// A number in single precision.
    F32(f32),
    /// A number in double precision.
    F64(f64),
    /// A real number.
    Exact(Root),
}

impl Value {
    /// A stored number as a hexadecimal float in the style of C's `%a`, which stands for itself exactly.
    #[must_use]
    pub fn hex(&self) -> Option<String> {
        match self {
            Self::F32(x) => Some(number::hex(*x)),
            Self::F64(x) => Some(number::hex64(*x)),
            Self::Absent | Self::Exact(_) => None,
        }
    }

    /// So many significant decimal digits (at least one), of the real number that it is, correctly rounded, ties to even:
    /// `1.2346e-7`; `0` for zero of either sign, `inf`, `-inf` and `NaN` as such, and nothing where it is absent.
    ///
    /// ```
    /// use rayproof_oracle::worked::Value;
    /// assert_eq!(Value::F32(0.1).decimal(20), "1.0000000149011611938e-1");
    /// ```
    #[must_use]
    pub fn decimal(&self, digits: usize) -> String {
        let float = |x: f64| exact(x).map_or_else(|| x.to_string(), |x| decimal(&x, digits));
        match self {
            Self::Absent => String::new(),
            Self::F32(x) => float(f64::from(*x)),
            Self::F64(x) => float(*x),
            Self::Exact(x) => decimal(x, digits),
        }
    }

    /// How many leading bytes of its [`decimal`](Self::decimal) agree with that of the exact value: all where both are
    /// equal, none where sign or exponent differ.
    #[must_use]
    pub fn same_digits(&self, exact: &Self, digits: usize) -> usize {
        let (shown, right) = (self.decimal(digits), exact.decimal(digits));
        if shown == right {
            return shown.len();
        }
        match (shown.split_once('e'), right.split_once('e')) {
            (Some((shown, e)), Some((right, f))) if e == f && shown.starts_with('-') == right.starts_with('-') => {
                shown.bytes().zip(right.bytes()).take_while(|(a, b)| a == b).count()
            }
            _ => 0,
        }
    }

    /// The distance from the exact value, in units in the last place of that value rounded to this one's format; below
    /// the normal numbers, and at zero, the unit is the smallest number there is.
    ///
    /// `None` where either is absent or not finite, the exact value in this one's format included; and of a value that is
    /// exact itself.
    #[must_use]
    pub fn ulps_from(&self, exact: &Self) -> Option<f64> {
        let (x, format) = match self {
            Self::F32(x) => (f64::from(*x), SINGLE),
            Self::F64(x) => (*x, DOUBLE),
            Self::Absent | Self::Exact(_) => return None,
        };
        let (x, right) = (RBig::try_from(x).ok()?, exact.real()?);
        let distance = right.minus(&x).abs();
        let unit = RBig::from(2).pow(format.unit_exponent(&right.abs())?);
        // 17 digits tell an f64 from its neighbours, and cancel nothing.
        decimal(&distance.times(&unit.pow(-1)), 17).parse().ok()
    }

    /// The real number that it is.
    fn real(&self) -> Option<Root> {
        match self {
            Self::Absent => None,
            Self::F32(x) => exact(f64::from(*x)),
            Self::F64(x) => exact(*x),
            Self::Exact(x) => Some(x.clone()),
        }
    }
}

impl From<f32> for Value {
    fn from(x: f32) -> Self {
        Self::F32(x)
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::F64(x)
    }
}

impl From<Root> for Value {
    fn from(x: Root) -> Self {
        Self::Exact(x)
    }
}

impl From<Number> for Value {
    fn from(x: Number) -> Self {
        Self::Exact(x.canonicalize().into())
    }
}

/// The number, where it is one.
fn exact(x: f64) -> Option<Root> {
    RBig::try_from(x).ok().map(Root::from)
}

/// [`Value::decimal`] of a real number.
fn decimal(x: &Root, digits: usize) -> String {
    let sign = match x.cmp_rational(&RBig::ZERO) {
        std::cmp::Ordering::Less => "-",
        std::cmp::Ordering::Equal => return "0".to_owned(),
        std::cmp::Ordering::Greater => "",
    };
    let (digits, exponent) = leading(&x.abs(), 10, digits.max(1));
    let digits = digits.to_string();
    let (first, rest) = digits.split_at(1);
    let point = if rest.is_empty() { "" } else { "." };
    format!("{sign}{first}{point}{rest}e{exponent}")
}

/// A binary format.
struct Format {
    /// The digits of a normal number.
    digits: usize,
    /// The exponents of the normal numbers.
    exponents: [isize; 2],
}

const SINGLE: Format = Format { digits: 24, exponents: [-126, 127] };
const DOUBLE: Format = Format { digits: 53, exponents: [-1022, 1023] };

impl Format {
    /// The power of two that is the unit in the last place of `x >= 0`, rounded; `None` where it rounds to infinity.
    fn unit_exponent(&self, x: &Root) -> Option<isize> {
        let [lowest, highest] = self.exponents;
        let zero = x.cmp_rational(&RBig::ZERO).is_eq();
        let exponent = if zero { lowest } else { leading(x, 2, self.digits).1.max(lowest) };
        (exponent <= highest).then(|| exponent + 1 - self.digits.cast_signed())
    }
}
