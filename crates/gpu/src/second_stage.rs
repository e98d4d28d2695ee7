//! Which numbers the second stage computes with: what keeps its promise on this device, and of two that do the faster.

use std::time::Instant;

use bytemuck::{Pod, Zeroable};
use rayproof_scene::random::Random;

use crate::Error;
use crate::compute::Alone;
use crate::context::Context;
use crate::dump::width_name;
use crate::kernel::Width;
use crate::link::Linked;
use crate::route::Route;

/// Pairs of numbers tried.
const PAIRS: u32 = 1 << 12;
/// Rounds of arithmetic a pair where the time is taken, at first and at most.
const ROUNDS: [u32; 2] = [1 << 8, 1 << 14];
/// A trial that takes less, in seconds, is mostly its submission, and the choice would be chance: it gets more rounds.
const SHORTEST: f64 = 1e-3;
/// Threads of a timed trial on hardware: enough to keep every unit busy, so that throughput is compared and not latency.
const THREADS: u32 = 1 << 17;

/// The numbers of a device's second stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SecondStage {
    /// For everything.
    pub width: Width,
    /// For the numbers of hits that those cannot round, where the device has wider ones.
    pub rest: Option<Width>,
}

impl std::fmt::Display for SecondStage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = |width| match width {
            Width::Single | Width::SingleByRule => "f32",
            Width::Double => "f64",
            Width::PairOfF32 => "pairs of f32",
            Width::PairOfF64 => "pairs of f64",
        };
        match self.rest {
            Some(rest) => write!(f, "{}, then {}", name(self.width), name(rest)),
            None => f.write_str(name(self.width)),
        }
    }
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Results {
    sum: [f32; 5],
    product: [f32; 5],
    quotient: [f32; 5],
    root: [f32; 5],
}

impl SecondStage {
    /// Tries each width on the device; `None` where none keeps its promise, or kernels take a route on which no bound holds.
    pub(crate) fn on(context: &Context, route: Route) -> Result<Option<Self>, Error> {
        if route != Route::ExactSpirv {
            return Ok(None);
        }
        let kept = |width: Width| -> Result<Option<Trial<'_>>, Error> {
            if width.needs_f64() && !context.has_f64() {
                return Ok(None);
            }
            let trial = Trial::new(context, width)?;
            Ok(is_kept(width, &trial.run(0, PAIRS)?).then_some(trial))
        };
        let rest = kept(Width::PairOfF64)?.map(|trial| trial.width);
        let mut trials = Vec::new();
        for width in [Width::Double, Width::PairOfF32] {
            trials.extend(kept(width)?);
        }
        Ok(fastest(&trials)?.map(|width| Self { width, rest }))
    }
}

/// The width in which the same arithmetic takes the least time.
fn fastest(trials: &[Trial<'_>]) -> Result<Option<Width>, Error> {
    if let [] | [_] = trials {
        return Ok(trials.first().map(|trial| trial.width));
    }
    let [mut rounds, most] = ROUNDS;
    loop {
        let times = trials.iter().map(|trial| trial.seconds(rounds)).collect::<Result<Vec<f64>, Error>>()?;
        let least = times.iter().copied().fold(f64::INFINITY, f64::min);
        if least >= SHORTEST || rounds >= most {
            return Ok(trials.iter().zip(&times).min_by(|a, b| a.1.total_cmp(b.1)).map(|(trial, _)| trial.width));
        }
        rounds *= 4;
    }
}

/// The trial's kernel in one width.
struct Trial<'c> {
    context: &'c Context,
    width: Width,
    kernel: Alone,
}

impl<'c> Trial<'c> {
    fn new(context: &'c Context, width: Width) -> Result<Self, Error> {
        let mut linked = Linked::default();
        width.link(&mut linked);
        linked.add("exact/number/trial.wgsl", rayproof_shaders::source("exact/number/trial.wgsl"));
        let name = format!("trial-{}", width_name(width));
        Ok(Self { context, width, kernel: context.compile_alone(&linked, ["trial", &name], Route::ExactSpirv)? })
    }

    fn run(&self, rounds: u32, threads: u32) -> Result<Vec<Results>, Error> {
        #[expect(clippy::cast_precision_loss, reason = "24 bits")]
        let given: Vec<[f32; 4]> = pairs().into_iter().map(|words| words.map(|word| word as f32)).collect();
        self.context.run_once(&self.kernel, [PAIRS, rounds], bytemuck::cast_slice(&given), PAIRS as usize, threads)
    }

    /// The least of three times that so many rounds take.
    fn seconds(&self, rounds: u32) -> Result<f64, Error> {
        let threads = if self.context.is_software() { PAIRS } else { THREADS };
        let mut least = f64::INFINITY;
        for _ in 0..3 {
            let start = Instant::now();
            self.run(rounds, threads)?;
            least = least.min(start.elapsed().as_secs_f64());
        }
        Ok(least)
    }
}

/// Two whole numbers of 48 bits each, as the upper and lower 24 bits.
fn pairs() -> Vec<[u32; 4]> {
    let mut random = Random::new(0x0af4_c319_77e0_51d2, 0);
    let mut next = || u32::try_from(random.below(1 << 24)).expect("24 bits");
    (0..PAIRS).map(|_| [next() | 1 << 23, next(), next() | 1 << 23, next()]).collect()
}

/// What the bounds of a width suppose: how far a result may be off, relative to it, as a power of two.
const fn promise(width: Width) -> u32 {
    match width {
        Width::Single | Width::SingleByRule => 22,
        Width::Double => 52,
        Width::PairOfF32 => 44,
        Width::PairOfF64 => 100,
    }
}

fn is_kept(width: Width, results: &[Results]) -> bool {
    let bits = promise(width);
    pairs().iter().zip(results).all(|(&[a, b, c, d], r)| {
        let [x, y] = [[a, b], [c, d]].map(|[high, low]| i128::from(high) << 24 | i128::from(low));
        let near = |words: [f32; 5], exact: i128| {
            whole(words).is_some_and(|found| found.abs_diff(exact) <= exact.unsigned_abs() >> bits)
        };
        // These two are derived from sums and products: what could be wrong with them is gross.
        #[expect(clippy::cast_precision_loss, reason = "48 bits")]
        let (x, y, exact_sum, exact_product) = (x as f64, y as f64, x + y, x * y);
        let close = |words: [f32; 5], exact: f64| {
            let found: f64 = words.iter().rev().copied().map(f64::from).sum();
            (found - exact).abs() <= exact * 2.0_f64.powi(-i32::try_from(bits.min(50)).expect("small"))
        };
        near(r.sum, exact_sum) && near(r.product, exact_product) && close(r.quotient, x / y) && close(r.root, x.sqrt())
    })
}

/// The sum of words that are whole.
fn whole(words: [f32; 5]) -> Option<i128> {
    #[expect(clippy::cast_possible_truncation, reason = "whole, and below 2^97")]
    let word = |w: f32| (w.fract() == 0.0 && w.abs() < 2.0_f32.powi(97)).then_some(w as i128);
    words.into_iter().map(word).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What numbers of 100 bits and more would answer.
    fn right() -> Vec<Results> {
        let words = |mut x: i128| {
            [(); 5].map(|()| {
                #[expect(clippy::cast_precision_loss, reason = "the next 24 bits")]
                let word = x as f32;
                #[expect(clippy::cast_possible_truncation, reason = "whole")]
                let rest = x - word as i128;
                x = rest;
                word
            })
        };
        #[expect(clippy::cast_possible_truncation, reason = "each the next 24 bits")]
        let float = |x: f64| {
            let a = x as f32;
            let b = (x - f64::from(a)) as f32;
            [a, b, (x - f64::from(a) - f64::from(b)) as f32, 0.0, 0.0]
        };
        pairs()
            .iter()
            .map(|&[a, b, c, d]| {
                let [x, y] = [[a, b], [c, d]].map(|[high, low]| i128::from(high) << 24 | i128::from(low));
                Results {
                    sum: words(x + y),
                    product: words(x * y),
                    quotient: float(x as f64 / y as f64),
                    root: float((x as f64).sqrt()),
                }
            })
            .collect()
    }

    #[test]
    fn what_is_off_by_more_than_promised_is_seen() {
        for width in [Width::Double, Width::PairOfF32, Width::PairOfF64] {
            assert!(is_kept(width, &right()), "{width:?}");
            let off = 2.0_f32.powi(2 - i32::try_from(promise(width)).expect("small"));
            let damages: [fn(&mut Results, f32); 4] = [
                |r, off| r.sum[2] += (r.sum[0] * off).ceil(),
                |r, off| r.product[4] += r.product[0] * off,
                |r, off| r.quotient[1] += r.quotient[0] * (off + 2.0_f32.powi(-48)),
                |r, off| r.root[1] += r.root[0] * (off + 2.0_f32.powi(-48)),
            ];
            for (i, damage) in damages.into_iter().enumerate() {
                let mut results = right();
                damage(&mut results[77], off);
                assert!(!is_kept(width, &results), "{width:?}, damage {i}");
            }
        }
    }
}
