//! Twins of `shaders/exact/`: the precision `exact`, a cascade.
//!
//! 1. [`first`]: the whole walk in `f32`, with certificates. Each primitive is hit, missed, or left open, by bounds on the
//!    rounding errors that `triangle` and `sphere` derive. A ray is decided when its closest certain hit lies before
//!    everything that was left open.
//! 2. [`second`]: the walk of a ray that is not decided, in `f64` with the same certificates; what they leave open is decided
//!    on the spot, in sums of two `f64` ([`two`]), and at last by exact arithmetic ([`resolve`]).
//! 3. [`values`]: `t`, `u` and `v` of the hit in `f64` with their errors; where those leave two `f32` to choose between, in
//!    sums of two `f64`, and at last exactly.

#[cfg(test)]
mod adversary;
#[cfg(test)]
mod adversary_tests;
pub(crate) mod candidate;
pub(crate) mod first;
pub(crate) mod line;
pub(crate) mod ray;
pub(crate) mod resolve;
mod ring;
pub(crate) mod second;
mod sphere;
mod triangle;
pub(crate) mod two;
mod values;
mod wide;

pub(crate) use first::{Crossings, First};
pub(crate) use ray::{FirstRay, first_ray};
pub(crate) use values::round;
