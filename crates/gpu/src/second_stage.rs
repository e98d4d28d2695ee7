//! Which numbers the second stage computes with: what keeps its promise on this device, and of two that do the faster.

use std::fmt;

use crate::Error;
use crate::context::Context;
use crate::kernel::Width;
use crate::route::Route;
use crate::trial::{Trial, Verdict};

/// Rounds of arithmetic a pair where the time is taken, at first and at most.
const ROUNDS: [u32; 2] = [1 << 8, 1 << 14];
/// A trial that takes less, in seconds, is mostly its submission, and the choice would be chance: it gets more rounds.
const SHORTEST: f64 = 1e-3;

/// The numbers of a device's second stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SecondStage {
    /// For everything.
    pub width: Width,
    /// For the numbers of hits that those cannot round, where the device has wider ones.
    pub rest: Option<Width>,
}

impl fmt::Display for SecondStage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.rest {
            Some(rest) => write!(f, "{}, then {rest}", self.width),
            None => write!(f, "{}", self.width),
        }
    }
}

/// What was tried for the second stage, and what was chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trials {
    /// `None` where nothing keeps its promise, or where kernels run as plain WGSL: no bound holds where a compiler may reassociate.
    pub chosen: Option<SecondStage>,
    /// Each width, and what came of its trial; none on a route on which no bound holds.
    pub verdicts: Vec<(Width, Verdict)>,
}

impl Trials {
    /// Tries each width on the device.
    pub(crate) fn run(context: &Context, route: Route) -> Result<Self, Error> {
        let (mut verdicts, mut kept) = (Vec::new(), Vec::new());
        if route == Route::ExactSpirv {
            for width in [Width::Double, Width::PairOfF32, Width::PairOfF64] {
                if width.needs_f64() && !context.has_f64() {
                    verdicts.push((width, Verdict::Missing));
                    continue;
                }
                let trial = Trial::new(context, width)?;
                let verdict = trial.verdict()?;
                verdicts.push((width, verdict));
                kept.extend((verdict == Verdict::Kept).then_some(trial));
            }
        }
        let rest = kept.pop_if(|trial| trial.width == Width::PairOfF64).map(|trial| trial.width);
        let chosen = fastest(&kept)?.map(|width| SecondStage { width, rest });
        Ok(Self { chosen, verdicts })
    }

    /// Whether a width keeps its promise on the device.
    #[must_use]
    pub fn keep(&self, width: Width) -> bool {
        self.verdicts.contains(&(width, Verdict::Kept))
    }

    /// Why a width was not taken for the second stage; `None` for one that was.
    #[must_use]
    pub fn why_not(&self, width: Width) -> Option<String> {
        let &(_, verdict) = self.verdicts.iter().find(|(tried, _)| *tried == width)?;
        match (verdict, self.chosen) {
            (Verdict::Kept, Some(SecondStage { width: taken, rest })) if taken != width && rest != Some(width) => {
                Some(format!("as good, but {taken} took less time"))
            }
            (Verdict::Kept, _) => None,
            (verdict, _) => Some(verdict.to_string()),
        }
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
