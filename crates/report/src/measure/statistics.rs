//! Quantiles, and bounds on rates.

use statrs::function::beta::inv_beta_reg;

use crate::model::{Quantiles, Rate, Timing};

/// The quantiles of values that are numbers: of each the smallest value that at least that share does not exceed.
pub(crate) fn quantiles(mut values: Vec<f64>) -> Quantiles {
    values.sort_unstable_by(f64::total_cmp);
    let n = values.len();
    let at = |share: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the list")]
        let place = (share * n as f64).ceil().max(1.0) as usize - 1;
        values.get(place.min(n.saturating_sub(1))).copied().unwrap_or(0.0)
    };
    Quantiles { n: n as u64, p50: at(0.5), p90: at(0.9), p99: at(0.99), p999: at(0.999), max: at(1.0) }
}

/// Median, 5th and 95th percentile of repeated measurements.
pub(crate) fn timing(values: Vec<f64>) -> Timing {
    let runs = u32::try_from(values.len()).expect("nobody waits for 2^32 runs");
    let mut sorted = values;
    sorted.sort_unstable_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let at = |share: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the list")]
        let place = (share * last as f64).round() as usize;
        sorted.get(place).copied().unwrap_or(0.0)
    };
    Timing { runs, p5: at(0.05), median: at(0.5), p95: at(0.95) }
}

/// A rate with its upper bound: the largest share with which so few would be seen in one of twenty runs (Clopper and Pearson
/// 1934), `I^-1(0.95; k + 1, n - k)`, the inverse of the regularised incomplete beta function.
pub(crate) fn rate(count: u64, of: u64) -> Rate {
    let bound = if count >= of { 1.0 } else { inv_beta_reg((count + 1) as f64, (of - count) as f64, 0.95) };
    Rate { count, of, bound }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The chance of at most `k` of `n` at a share of `p`.
    fn at_most(k: u64, n: u64, p: f64) -> f64 {
        let mut term = (1.0 - p).powi(i32::try_from(n).expect("small"));
        let mut sum = term;
        for i in 0..k {
            term *= (n - i) as f64 / (i + 1) as f64 * p / (1.0 - p);
            sum += term;
        }
        sum
    }

    #[test]
    fn a_bound_is_where_so_few_are_one_in_twenty() {
        for (k, n) in [(0, 1), (0, 100), (1, 10), (3, 200), (40, 100), (9, 10), (7, 1000)] {
            let Rate { bound, .. } = rate(k, n);
            assert!((at_most(k, n, bound) - 0.05).abs() < 1e-6, "{k} of {n}: {bound}");
        }
        assert!((rate(0, 1_000_000).bound - 2.9957e-6).abs() < 1e-9, "the rule of three");
        assert_eq!((rate(5, 5).bound, rate(0, 0).bound), (1.0, 1.0));
    }

    #[test]
    fn quantiles_are_values_of_the_list() {
        let q = quantiles((1..=1000).rev().map(f64::from).collect());
        assert_eq!((q.n, q.p50, q.p90, q.p99, q.p999, q.max), (1000, 500.0, 900.0, 990.0, 999.0, 1000.0));
        let q = quantiles(vec![3.0, 1.0]);
        assert_eq!((q.p50, q.p999, q.max), (1.0, 3.0, 3.0));
        assert_eq!(quantiles(Vec::new()), Quantiles::default());
        let t = timing((1..=21).map(f64::from).collect());
        assert_eq!((t.runs, t.p5, t.median, t.p95), (21, 2.0, 11.0, 20.0));
    }
}
