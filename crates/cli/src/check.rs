//! `--check`: rays answered again in exact arithmetic.

use rayon::prelude::*;
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
    /// Not the exact answer, but one that the precision tier allows.
    pub(crate) within_promise: u64,
    pub(crate) disagreed: u64,
}

/// Asks the oracle about every sample, in parallel, and prints the disagreements on stderr, the first few in full.
pub(crate) fn check<A: Answer>(scene: &Scene, samples: &[Sample<A>], quiet: bool) -> Checked {
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
            match verdict {
                Verdict::Exact(_) => {}
                Verdict::WithinPromise(_) => checked.within_promise += 1,
                Verdict::Disagrees(..) => {
                    checked.disagreed += 1;
                    if checked.disagreed <= PRINTED {
                        progress.suspend(|| say(format_args!("ray {}: {verdict}", sample.index)));
                    }
                }
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
