//! The three questions that can be asked of a ray, and what goes with each.

use rayproof::files::{self, HitKind, HitWriter};
use rayproof::scene::{Hit, Ray, Undecided};
use rayproof::{Error, Intersector};
use rayproof_oracle::Oracle;
use rayproof_oracle::judge::{Verdict, judge_any, judge_closest, judge_count};

/// An answer to one ray.
pub(crate) trait Answer: Copy + Send + Sync + 'static {
    /// The query's name on the command line.
    const QUERY: &'static str;
    /// What the file of answers holds.
    const KIND: HitKind;
    /// The answer to a ray that hits nothing.
    const MISS: Self;

    /// Asks the engine; returned is how many rays its stages left open.
    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error>;
    /// Appends answers to the file.
    fn write(writer: &mut HitWriter, answers: &[Self]) -> Result<(), files::Error>;
    /// Whether the ray hits anything.
    fn is_hit(&self) -> bool;
    /// Asks the oracle.
    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict;
}

impl Answer for Hit {
    const QUERY: &'static str = "closest";
    const KIND: HitKind = HitKind::Closest;
    const MISS: Self = Self::MISS;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.closest(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self]) -> Result<(), files::Error> {
        writer.write_closest(answers)
    }

    fn is_hit(&self) -> bool {
        Self::is_hit(self)
    }

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_closest(oracle, ray, &oracle.scene().flat_hit(self))
    }
}

/// 1 for a hit, 0 for a miss.
impl Answer for u8 {
    const QUERY: &'static str = "any";
    const KIND: HitKind = HitKind::Any;
    const MISS: Self = 0;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.any(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self]) -> Result<(), files::Error> {
        writer.write_any(answers)
    }

    fn is_hit(&self) -> bool {
        *self != 0
    }

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_any(oracle, ray, *self)
    }
}

/// The number of crossings.
impl Answer for u32 {
    const QUERY: &'static str = "count";
    const KIND: HitKind = HitKind::Count;
    const MISS: Self = 0;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.count(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self]) -> Result<(), files::Error> {
        writer.write_count(answers)
    }

    fn is_hit(&self) -> bool {
        *self != 0
    }

    fn judge(&self, oracle: &Oracle, ray: &Ray) -> Verdict {
        judge_count(oracle, ray, *self)
    }
}
