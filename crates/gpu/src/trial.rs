//! A width of numbers on trial: whether its operations keep what the bounds of `exact` suppose, and which does not.

use std::fmt;
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
/// Threads of a timed trial on hardware: enough to keep every unit busy, so that throughput is compared and not latency.
const THREADS: u32 = 1 << 17;

/// What a trial found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every operation keeps its promise.
    Kept,
    /// The device has no such numbers.
    Missing,
    /// The first operation that does not keep it.
    Broken {
        /// Which.
        operation: &'static str,
        /// In how many pairs of numbers.
        wrong: usize,
        /// Of how many.
        pairs: usize,
    },
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kept => f.write_str("keep their promise"),
            Self::Missing => f.write_str("the device has none"),
            Self::Broken { operation, wrong, pairs } => write!(f, "{operation} wrong in {wrong} of {pairs} pairs"),
        }
    }
}

/// Words of a number: five `f32` whose sum it is.
type Words = [f32; 5];

/// What each operation gave; `Results` in `shaders/exact/number/trial.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Results {
    conversion: Words,
    sum: Words,
    difference: Words,
    product: Words,
    quotient: Words,
    root: Words,
    order: Words,
    size: Words,
}

/// The trial's kernel in one width.
pub(crate) struct Trial<'c> {
    context: &'c Context,
    pub(crate) width: Width,
    kernel: Alone,
}

impl<'c> Trial<'c> {
    pub(crate) fn new(context: &'c Context, width: Width) -> Result<Self, Error> {
        let mut linked = Linked::default();
        width.link(&mut linked);
        linked.add("exact/number/trial.wgsl", rayproof_shaders::source("exact/number/trial.wgsl"));
        let name = format!("trial-{}", width_name(width));
        Ok(Self { context, width, kernel: context.compile_alone(&linked, ["trial", &name], Route::ExactSpirv)? })
    }

    /// What came of it.
    pub(crate) fn verdict(&self) -> Result<Verdict, Error> {
        Ok(judge(self.width, &self.run(0, PAIRS)?))
    }

    fn run(&self, rounds: u32, threads: u32) -> Result<Vec<Results>, Error> {
        #[expect(clippy::cast_precision_loss, reason = "24 bits")]
        let given: Vec<[f32; 4]> = pairs().into_iter().map(|words| words.map(|word| word as f32)).collect();
        self.context.run_once(&self.kernel, [PAIRS, rounds], bytemuck::cast_slice(&given), PAIRS as usize, threads)
    }

    /// The least of three times that so many rounds take.
    pub(crate) fn seconds(&self, rounds: u32) -> Result<f64, Error> {
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
        Width::PairOfF32 => 45,
        Width::PairOfF64 => 100,
    }
}

/// Operations in the order in which one builds on those before: where conversions fail, so does the reading of all others.
fn judge(width: Width, results: &[Results]) -> Verdict {
    let bits = promise(width);
    type Keeps = fn(&Results, [i128; 2], u32) -> bool;
    let operations: [(&str, Keeps); 8] = [
        ("conversion to f32 and back", |r, [x, _], _| whole(r.conversion) == Some(x)),
        ("sum", |r, [x, y], bits| near(r.sum, x + y, bits)),
        ("difference", |r, [x, y], bits| near(r.difference, x - y, bits)),
        ("product", |r, [x, y], bits| near(r.product, x * y, bits)),
        ("quotient", |r, [x, y], bits| close(r.quotient, x as f64 / y as f64, bits)),
        ("square root", |r, [x, _], bits| close(r.root, (x as f64).sqrt(), bits)),
        ("minimum or maximum", |r, [x, y], bits| near(r.order, (x - y).abs(), bits)),
        ("comparison or size", |r, [x, y], bits| near(r.size, (x - y).abs(), bits)),
    ];
    let pairs: Vec<[i128; 2]> = pairs()
        .into_iter()
        .map(|[a, b, c, d]| [[a, b], [c, d]].map(|[high, low]| i128::from(high) << 24 | i128::from(low)))
        .collect();
    for (operation, keeps) in operations {
        let wrong = pairs.iter().zip(results).filter(|(pair, r)| !keeps(r, **pair, bits)).count();
        if wrong > 0 {
            return Verdict::Broken { operation, wrong, pairs: pairs.len() };
        }
    }
    Verdict::Kept
}

fn near(words: Words, exact: i128, bits: u32) -> bool {
    whole(words).is_some_and(|found| found.abs_diff(exact) <= exact.unsigned_abs() >> bits)
}

/// Quotients and roots are derived from sums and products: what could be wrong with them is gross. Bounds allow for twice as much.
fn close(words: Words, exact: f64, bits: u32) -> bool {
    let found: f64 = words.iter().rev().copied().map(f64::from).sum();
    (found - exact).abs() <= exact * 2.0_f64.powi(-i32::try_from((bits - 1).min(50)).expect("small"))
}

/// The sum of words that are whole.
fn whole(words: Words) -> Option<i128> {
    #[expect(clippy::cast_possible_truncation, reason = "whole, and below 2^97")]
    let word = |w: f32| (w.fract() == 0.0 && w.abs() < 2.0_f32.powi(97)).then_some(w as i128);
    words.into_iter().map(word).sum()
}

#[cfg(test)]
mod tests;
