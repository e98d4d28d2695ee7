//! `--check`: rays answered again in exact arithmetic.

use rayproof::Precision;
use rayproof::files::HitKind;
use rayproof::scene::Scene;
use rayproof::stream::{self, Checked, Judgement, Sample};
use rayproof_oracle::Oracle;
use rayproof_oracle::judge::Verdict;

use crate::exit::say;
use crate::judged::Judged;
use crate::progress::Progress;

/// How many disagreements are printed in full.
const PRINTED: u64 = 10;

/// Asks the oracle about every sample, in parallel, and prints the disagreements on stderr, the first few in full.
pub(crate) fn check<A: Judged>(scene: &Scene, samples: &[Sample<A>], precision: Precision, quiet: bool) -> Checked {
    if samples.is_empty() {
        return Checked::default();
    }
    let oracle = Oracle::new(scene);
    let progress = Progress::new("checking", Some(samples.len() as u64), quiet);
    let mut printed = 0;
    let checked = stream::check(
        samples,
        |sample| judge(sample, &oracle, precision),
        |sample, fault| {
            if printed < PRINTED {
                progress.suspend(|| say(format_args!("ray {}: {fault}", sample.index)));
                printed += 1;
            }
        },
        |judged| progress.add(judged),
    );
    drop(progress);
    if checked.disagreed > PRINTED {
        say(format_args!("... and {} disagreements more", checked.disagreed - PRINTED));
    }
    checked
}

/// The precision `classic` promises nothing: there an answer that only the promise of another precision allows is a disagreement. The
/// precision `exact` promises the exact answer, each number rounded to the nearest: there anything else is one.
fn judge<A: Judged>(sample: &Sample<A>, oracle: &Oracle, precision: Precision) -> Judgement {
    match sample.answer.judge(oracle, &sample.ray) {
        verdict if precision == Precision::Exact && !verdict.is_nearest() => {
            Judgement::Wrong(format!("disagrees: it is not the exact answer, correctly rounded\n{verdict}"))
        }
        Verdict::Exact(errors) => Judgement::Exact { ulps: (A::KIND == HitKind::Closest).then_some(errors.t) },
        Verdict::WithinPromise(case) if precision != Precision::Fast => {
            let name = precision.name();
            Judgement::Wrong(format!("disagrees: it is not the exact answer, and {name} promises no other\n{case}"))
        }
        Verdict::WithinPromise(_) => Judgement::WithinPromise,
        verdict @ Verdict::Disagrees(..) => Judgement::Wrong(verdict.to_string()),
    }
}
