//! Numbers and words as readers see them: one function for each kind, used everywhere.

use crate::model::{Quantiles, Rate, Timing};

/// Text for HTML and SVG.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// `1234567` as `1,234,567`.
#[must_use]
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Three significant digits; beyond a million and below a thousandth as a power of ten.
pub(crate) fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{x:.1e}");
    }
    if size >= 999.5 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below a million")]
        return format!("{}{}", if x < 0.0 { "-" } else { "" }, count(size.round() as u64));
    }
    let decimals = if size >= 99.95 {
        0
    } else if size >= 9.995 {
        1
    } else if size >= 0.9995 {
        2
    } else {
        3
    };
    format!("{x:.decimals$}")
}

/// A share as a percentage.
pub(crate) fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

/// How often, of how many, and the bound.
pub(crate) fn rate(rate: &Rate) -> String {
    let Rate { count: n, of, bound } = *rate;
    if of == 0 {
        return "none asked".to_owned();
    }
    let bound = percent(bound);
    if n == 0 {
        return format!("0 of {} (≤ {bound})", count(of));
    }
    format!("{} of {}, {} (≤ {bound})", count(n), count(of), percent(n as f64 / of as f64))
}

/// A share alone; zero as its bound.
pub(crate) fn share(rate: &Rate) -> String {
    match (rate.count, rate.of) {
        (_, 0) => "–".to_owned(),
        (0, _) => format!("0 (≤ {})", percent(rate.bound)),
        (n, of) => percent(n as f64 / of as f64),
    }
}

/// The median with the 5th and 95th percentile.
pub(crate) fn timing(t: &Timing) -> String {
    format!("{} ({}–{})", number(t.median), number(t.p5), number(t.p95))
}

/// A quantile, or a dash where there is none.
pub(crate) fn quantile(q: &Quantiles, of: fn(&Quantiles) -> f64) -> String {
    if q.n == 0 { "–".to_owned() } else { number(of(q)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let expected = [
            (0.0, "0"),
            (0.5, "0.500"),
            (1.234, "1.23"),
            (9.999, "10.0"),
            (12.34, "12.3"),
            (99.96, "100"),
            (123.4, "123"),
            (999.7, "1,000"),
            (12_345.6, "12,346"),
            (1.234e7, "1.2e7"),
            (1.234e-7, "1.2e-7"),
            (-2.5, "-2.50"),
            (-1234.0, "-1,234"),
        ];
        for (x, text) in expected {
            assert_eq!(number(x), text);
        }
        assert_eq!(count(1_234_567), "1,234,567");
        assert_eq!(escape("a<b & \"c\">"), "a&lt;b &amp; &quot;c&quot;&gt;");
    }

    #[test]
    fn rates_never_hide_what_they_are_of() {
        assert_eq!(rate(&Rate { count: 0, of: 1000, bound: 0.003 }), "0 of 1,000 (≤ 0.300 %)");
        assert_eq!(rate(&Rate { count: 5, of: 50, bound: 0.2 }), "5 of 50, 10.0 % (≤ 20.0 %)");
        assert_eq!(rate(&Rate { count: 0, of: 0, bound: 1.0 }), "none asked");
        assert_eq!(share(&Rate { count: 0, of: 1000, bound: 0.003 }), "0 (≤ 0.300 %)");
    }
}
