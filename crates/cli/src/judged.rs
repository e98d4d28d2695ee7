//! The three questions of the command line, and who judges their answers.

use rayproof::scene::{Hit, Ray};
use rayproof::stream::Answer;
use rayproof_oracle::Oracle;
use rayproof_oracle::judge::{Verdict, judge_any, judge_closest, judge_count};

/// An answer that the oracle can judge.
pub(crate) trait Judged: Answer {
    /// The query's name on the command line.
    const QUERY: &'static str;

    /// Asks the oracle.
    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict;
}

impl Judged for Hit {
    const QUERY: &'static str = "closest";

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_closest(oracle, ray, &oracle.scene().flat_hit(self))
    }
}

impl Judged for u8 {
    const QUERY: &'static str = "any";

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_any(oracle, ray, *self)
    }
}

impl Judged for u32 {
    const QUERY: &'static str = "count";

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_count(oracle, ray, *self)
    }
}
