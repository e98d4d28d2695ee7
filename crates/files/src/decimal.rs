//! Numbers as a file gives them, and rounded to `f32`, once.

use std::str::from_utf8;

use rayproof_scene::number;

/// A number: the nearest `f64` to what the file says, and the nearest `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Number {
    pub(crate) wide: f64,
    pub(crate) single: f32,
}

impl From<f32> for Number {
    fn from(single: f32) -> Self {
        Self { wide: f64::from(single), single }
    }
}

impl From<f64> for Number {
    fn from(wide: f64) -> Self {
        Self { wide, single: nearest(wide) }
    }
}

impl Number {
    /// A decimal. Rounded by way of `f64` it could be rounded twice: where that lands between two `f32`, the decimals decide.
    pub(crate) fn parse(word: &[u8]) -> Option<Self> {
        let text = from_utf8(word).ok()?;
        let wide: f64 = text.parse().ok()?;
        let single = if may_be_between(wide) { text.parse().ok()? } else { nearest(wide) };
        Some(Self { wide, single })
    }

    /// A decimal, or a hexadecimal float that is an `f32`.
    pub(crate) fn parse_any(word: &[u8]) -> Option<Self> {
        if word.contains(&b'x') || word.contains(&b'X') {
            return number::parse(from_utf8(word).ok()?).map(Self::from);
        }
        Self::parse(word)
    }

    /// By how much rounding moves it.
    pub(crate) const fn shift(self) -> f64 {
        (self.wide - self.single as f64).abs()
    }

    /// The number minus one that has been chosen as 0: exactly, then rounded once.
    pub(crate) fn minus(self, origin: f64) -> Self {
        if origin == 0.0 {
            return self;
        }
        let wide = self.wide - origin;
        // What the subtraction lost (Knuth's two-sum), as a last bit that is odd: no digit is rounded twice.
        let back = wide - self.wide;
        let lost = (self.wide - (wide - back)) - (origin + back);
        if lost == 0.0 || !wide.is_finite() || wide.to_bits() & 1 == 1 {
            return wide.into();
        }
        let toward = if (lost > 0.0) == (wide > 0.0) { wide.to_bits() + 1 } else { wide.to_bits() - 1 };
        Self { wide, single: nearest(f64::from_bits(toward)) }
    }
}

/// Whether an `f64` may be in the middle of two `f32`: its last 29 bits are 10..0, or it is below the normal range.
fn may_be_between(wide: f64) -> bool {
    const BELOW: u64 = (1 << 29) - 1;
    wide.to_bits() & BELOW == 1 << 28 || (wide != 0.0 && wide.abs() < f64::from(f32::MIN_POSITIVE))
}

/// The nearest `f32`; infinite beyond its range.
#[expect(clippy::cast_possible_truncation, reason = "`as` rounds to the nearest, which is what a loader promises")]
pub(crate) const fn nearest(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_rounded_once() {
        for word in [
            "1.00000005960464477540",
            "1.00000005960464477539062500001",
            "1.00000005960464477539062499999",
            "1.0000000596046447753906250",
            "7.0064923216240853546186479164495e-46",
            "7.0064923216240853546186479164496e-46",
            "1.0e-45",
            "2.1e-45",
            "3.4028235677973366e38",
            "3.4028235677973365e38",
            "1e-400",
            "-0",
            "+.5",
            "1.",
            "nan",
            "inf",
            "1e39",
        ] {
            let known: f32 = word.parse().expect("a number");
            assert_eq!(Number::parse(word.as_bytes()).map(|x| x.single.to_bits()), Some(known.to_bits()), "{word}");
        }
        assert_eq!(Number::parse(b"1,5"), None);
        assert_eq!(Number::parse(b"\xff"), None);
    }

    #[test]
    fn a_difference_is_rounded_once() {
        // 2^-70 is lost in f64, and decides a tie of f32.
        let tie = 1.0 + 2.0_f64.powi(-24);
        for (x, origin, known) in [
            (tie, -(2.0_f64.powi(-70)), 1.0 + f32::EPSILON),
            (tie, 2.0_f64.powi(-70), 1.0),
            (tie, 0.0, 1.0),
            (-tie, 2.0_f64.powi(-70), -1.0 - f32::EPSILON),
            (4_649_776.05, 4_649_776.0, 0.05),
            (f64::MAX, -f64::MAX, f32::INFINITY),
        ] {
            assert_eq!(Number::from(x).minus(origin).single, known, "{x:e} - {origin:e}");
        }
    }
}
