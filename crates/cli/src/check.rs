//! `--check`: rays answered again in exact arithmetic.

use rayon::prelude::*;
use rayproof::Precision;
use rayproof::files::HitKind;
use rayproof::scene::Scene;
use rayproof_oracle::Oracle;
use rayproof_oracle::judge::Verdict;

use crate::answer::Answer;
use crate::exit::say;
use crate::progress::Progress;
use crate::sample::Sample;

/// How many disagreements are printed in full.
const PRINTED: u64 = 10;
/// Rays between two looks at the progress bar.
const CHUNK: usize = 256;

/// What the check came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Checked {
    pub(crate) checked: u64,
    /// The exact answer, with `t` rounded to the nearest.
    pub(crate) correctly_rounded: u64,
    /// How far `t` is off at most among the answers with the exact primitive; `None` where no answer has a `t`.
    pub(crate) worst_ulp: Option<u64>,
    /// Not the exact answer, but one that the precision allows.
    pub(crate) within_promise: u64,
    pub(crate) disagreed: u64,
}

/// Asks the oracle about every sample, in parallel, and prints the disagreements on stderr, the first few in full.
///
/// The precision `classic` promises nothing: there an answer that only the promise of another precision allows is a disagreement. The
/// precision `exact` promises the exact answer, each number rounded to the nearest: there anything else is one.
pub(crate) fn check<A: Answer>(scene: &Scene, samples: &[Sample<A>], precision: Precision, quiet: bool) -> Checked {
    if samples.is_empty() {
        return Checked::default();
    }
    let oracle = Oracle::new(scene);
    let progress = Progress::new("checking", Some(samples.len() as u64), quiet);
    let mut checked = Checked::default();
    for chunk in samples.chunks(CHUNK) {
        let verdicts: Vec<Verdict> = chunk.par_iter().map(|s| s.answer.judge(&oracle, &s.ray)).collect();
        for (sample, verdict) in chunk.iter().zip(verdicts) {
            checked.checked += 1;
            let fault = match verdict {
                _ if precision == Precision::Exact && !verdict.is_nearest() => {
                    format!("disagrees: it is not the exact answer, correctly rounded\n{verdict}")
                }
                Verdict::Exact(errors) => {
                    checked.correctly_rounded += u64::from(errors.t == 0);
                    if A::KIND == HitKind::Closest {
                        checked.worst_ulp = checked.worst_ulp.max(Some(errors.t));
                    }
                    continue;
                }
                Verdict::WithinPromise(case) if precision != Precision::Fast => {
                    let name = precision.name();
                    format!("disagrees: it is not the exact answer, and {name} promises no other\n{case}")
                }
                Verdict::WithinPromise(_) => {
                    checked.within_promise += 1;
                    continue;
                }
                Verdict::Disagrees(..) => verdict.to_string(),
            };
            checked.disagreed += 1;
            if checked.disagreed <= PRINTED {
                progress.suspend(|| say(format_args!("ray {}: {fault}", sample.index)));
            }
        }
        progress.add(chunk.len());
    }
    drop(progress);
    if checked.disagreed > PRINTED {
        say(format_args!("... and {} disagreements more", checked.disagreed - PRINTED));
    }
    checked
}
