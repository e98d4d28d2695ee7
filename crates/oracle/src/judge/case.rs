use std::fmt;

use rayproof_scene::{Hit, Ray, Scene};

/// An answer to one ray, of any query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// To the query `closest`, with the hit's `(geometry, primitive)` where the scene has it.
    Closest(Hit, Option<(usize, usize)>),
    /// To the query `any`: 0 or 1.
    Any(u8),
    /// To the query `count`.
    Count(u32),
}

impl Answer {
    pub(crate) fn closest(scene: &Scene, hit: Hit) -> Self {
        let flat = hit.primitive as usize;
        Self::Closest(hit, (flat < scene.len()).then(|| scene.locate(flat)))
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Closest(hit, place) => {
                write!(f, "{}", show_hit(hit))?;
                place.map_or(Ok(()), |(geometry, primitive)| write!(f, " (geometry {geometry}, primitive {primitive})"))
            }
            Self::Any(hit) => write!(f, "any {hit}"),
            Self::Count(count) => write!(f, "count {count}"),
        }
    }
}

/// One ray with the exact answer and the one judged. It displays as a block of lines that gives every number as its
/// bits and as the shortest decimal that reads back to them.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The ray.
    pub ray: Ray,
    /// The exact answer, its numbers rounded to the nearest.
    pub exact: Answer,
    /// The answer judged.
    pub answer: Answer,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { ray, exact, answer } = self;
        let show = |numbers: &[f32]| numbers.iter().map(|&x| bits(x)).collect::<Vec<_>>().join("  ");
        writeln!(f, "  origin     {}", show(&ray.origin.to_array()))?;
        writeln!(f, "  direction  {}", show(&ray.direction.to_array()))?;
        writeln!(f, "  range      {}", show(&[ray.t_min, ray.t_max]))?;
        writeln!(f, "  exact      {exact}")?;
        writeln!(f, "  answer     {answer}")
    }
}

/// Why an answer is wrong.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// A NaN.
    #[error("t, u or v is not a number")]
    NotANumber,
    /// A miss that does not read as one.
    #[error("a miss is t = inf, u = v = 0")]
    MalformedMiss,
    /// A primitive that the scene does not have.
    #[error("the scene has no such primitive")]
    NoSuchPrimitive,
    /// Neither 0 nor 1.
    #[error("any is 0 or 1")]
    NotAFlag,
    /// A `t` before `t_min` or after `t_max`.
    #[error("t is outside the ray's range")]
    OutOfRange,
    /// Weights that no point of the primitive has.
    #[error("u, v is no point of the primitive")]
    OutsidePrimitive,
    /// The right primitive at another place.
    #[error("t, u or v is off by {0:.3e} times what single precision allows")]
    WrongNumbers(f64),
    /// A primitive that is not there.
    #[error("the ray does not hit that primitive there: off by {0:.3e} times what single precision allows")]
    FalseHit(f64),
    /// A hit that is plain in single precision, and nearer than the answer.
    #[error("a clear hit was passed over: primitive {primitive} at t = {t:?}")]
    PassedOver {
        /// The flat number of the primitive.
        primitive: u32,
        /// Where the ray hits it, rounded.
        t: f32,
    },
    /// A flag or a count that no single-precision evaluation gives.
    #[error("nothing close to the ray accounts for the answer")]
    Unaccounted,
}

/// A number as its bits and as the shortest decimal that reads back to them.
pub(super) fn bits(x: f32) -> String {
    format!("{:#010x} {x:?}", x.to_bits())
}

/// A hit in one line.
pub(super) fn show_hit(hit: &Hit) -> String {
    let Hit { t, u, v, primitive } = *hit;
    let id = if hit.is_hit() { format!("hit {primitive}") } else { "miss".to_owned() };
    format!("{id}  t {}  u {}  v {}", bits(t), bits(u), bits(v))
}
