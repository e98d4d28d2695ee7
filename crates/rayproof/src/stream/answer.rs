use rayproof_files::{self as files, HitKind, HitWriter, Kept};
use rayproof_scene::{Hit, Ray, Undecided};

use crate::{Error, Intersector};

/// An answer to one ray: a [`Hit`] to "where first?", a `u8` to "at all?", a `u32` to "how often?".
pub trait Answer: Copy + Send + Sync + 'static {
    /// What the file of answers holds.
    const KIND: HitKind;
    /// The answer to a ray that hits nothing.
    const MISS: Self;

    /// Asks the engine; returned is how many rays its stages left open.
    ///
    /// # Errors
    /// As the question of [`Intersector`] that it asks.
    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error>;

    /// Appends answers to a file of [`KIND`](Self::KIND), and what is kept of their rays.
    ///
    /// # Errors
    /// When writing fails.
    fn write(writer: &mut HitWriter, answers: &[Self], kept: &Kept) -> Result<(), files::Error>;

    /// Whether the ray hits anything.
    fn is_hit(&self) -> bool;
}

impl Answer for Hit {
    const KIND: HitKind = HitKind::Closest;
    const MISS: Self = Self::MISS;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.closest(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self], kept: &Kept) -> Result<(), files::Error> {
        writer.write_closest(answers, kept)
    }

    fn is_hit(&self) -> bool {
        Self::is_hit(self)
    }
}

/// 1 for a hit, 0 for a miss.
impl Answer for u8 {
    const KIND: HitKind = HitKind::Any;
    const MISS: Self = 0;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.any(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self], kept: &Kept) -> Result<(), files::Error> {
        writer.write_any(answers, kept)
    }

    fn is_hit(&self) -> bool {
        *self != 0
    }
}

/// The number of crossings.
impl Answer for u32 {
    const KIND: HitKind = HitKind::Count;
    const MISS: Self = 0;

    fn trace(engine: &Intersector, rays: &[Ray], answers: &mut [Self]) -> Result<Undecided, Error> {
        engine.count(rays, answers)
    }

    fn write(writer: &mut HitWriter, answers: &[Self], kept: &Kept) -> Result<(), files::Error> {
        writer.write_count(answers, kept)
    }

    fn is_hit(&self) -> bool {
        *self != 0
    }
}
