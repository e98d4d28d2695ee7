//! Numbers as text: decimal, or hexadecimal floats as C prints them with `%a`, which stand for themselves exactly.

/// The number that a word says: a decimal, rounded once to the nearest `f32`; or a hexadecimal float such as `-0x1.8p+3`, which
/// must be an `f32` exactly.
///
/// ```
/// use rayproof_scene::number;
/// assert_eq!(number::parse("-0x1.8p+3"), Some(-12.0));
/// assert_eq!(number::parse("0.1"), Some(0.1));
/// assert_eq!(number::parse("0x1.00000001p0"), None);
/// ```
#[must_use]
pub fn parse(word: &str) -> Option<f32> {
    let (sign, rest) = match word.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, word.strip_prefix('+').unwrap_or(word)),
    };
    match rest.strip_prefix("0x").or_else(|| rest.strip_prefix("0X")) {
        Some(digits) => magnitude(digits).map(|x| sign * x),
        None => word.parse().ok(),
    }
}

/// `H.HHHpE` as the `f32` that it is.
#[expect(clippy::cast_possible_truncation, reason = "compared with what it was")]
fn magnitude(text: &str) -> Option<f32> {
    let (mantissa, exponent) = text.split_once(['p', 'P'])?;
    let exponent: i32 = exponent.parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = whole.len() + fraction.len();
    if digits == 0 || digits > 13 || !(-1100..=1100).contains(&exponent) {
        return None;
    }
    let mut value = 0_u64;
    for digit in whole.chars().chain(fraction.chars()) {
        value = value * 16 + u64::from(digit.to_digit(16)?);
    }
    let shift = exponent - 4 * i32::try_from(fraction.len()).ok()?;
    // 52 bits are exact in f64; scaled in two steps, each exact or beyond what an f32 can be.
    let wide = value as f64 * 2.0_f64.powi(shift / 2) * 2.0_f64.powi(shift - shift / 2);
    let single = wide as f32;
    (f64::from(single) == wide && single.is_finite() && (single != 0.0 || value == 0)).then_some(single)
}

/// A number as a hexadecimal float; `inf` and `-inf` as such.
///
/// ```
/// use rayproof_scene::number;
/// assert_eq!(number::hex(-12.0), "-0x1.8p+3");
/// assert_eq!(number::hex(f32::from_bits(1)), "0x1p-149");
/// ```
#[must_use]
pub fn hex(x: f32) -> String {
    hex64(f64::from(x))
}

/// An `f64` as a hexadecimal float; `inf` and `-inf` as such.
///
/// ```
/// use rayproof_scene::number;
/// assert_eq!(number::hex64(-0.1), "-0x1.999999999999ap-4");
/// assert_eq!(number::hex64(f64::from_bits(3)), "0x1.8p-1073");
/// ```
#[must_use]
pub fn hex64(x: f64) -> String {
    if !x.is_finite() || x == 0.0 {
        return if x == 0.0 { "0x0p+0".to_owned() } else { x.to_string() };
    }
    // A subnormal becomes normal by 2^64, exactly.
    let (bits, shift) = if x.is_normal() { (x.to_bits(), 0) } else { ((x * 2.0_f64.powi(64)).to_bits(), 64) };
    let (exponent, fraction) = ((bits >> 52 & 0x7ff).cast_signed() - 1023 - shift, bits << 12 >> 12);
    let digits = format!("{fraction:013x}");
    let digits = digits.trim_end_matches('0');
    let (sign, point) = (if x < 0.0 { "-" } else { "" }, if digits.is_empty() { "" } else { "." });
    format!("{sign}0x1{point}{digits}p{exponent:+}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_reads_back() {
        let mut bits = 1_u32;
        for _ in 0..100_000 {
            bits = bits.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let x = f32::from_bits(bits);
            if !x.is_nan() {
                assert_eq!(parse(&hex(x)), Some(x), "{}", hex(x));
            }
        }
        for x in [0.0, f32::MAX, f32::MIN_POSITIVE, f32::from_bits(1), -f32::from_bits(0x7f_ffff), f32::INFINITY] {
            assert_eq!(parse(&hex(x)), Some(x));
        }
    }

    #[test]
    fn what_is_no_f32_or_no_number_is_none() {
        let inexact = ["0x1.0000001p0", "0x1p-150", "0x1p128", "0x1.8p-149", "0x1p99999", "0x123456789abcdefp0"];
        let broken =
            ["", "0x", "0xp1", "0x1", "0x1p", "0x1.8", "0xg.p1", "0x1p1.5", "0x1 p1", "--0x1p1", "+-0x1p1", "x"];
        for text in inexact.into_iter().chain(broken) {
            assert_eq!(parse(text), None, "{text:?}");
        }
        assert_eq!(parse("0X1.8P3"), Some(12.0));
        assert_eq!(parse("+0x.8p1"), Some(1.0));
    }
}
