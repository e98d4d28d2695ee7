//! The precision `exact`, a cascade of stages.
//!
//! 1. The first is a twin of the kernels (`twin/exact/`): the whole walk in `f32`, with certificates. Each primitive is hit,
//!    missed, or left open, by bounds on the rounding errors that `triangle.wgsl` and `sphere.wgsl` derive. A ray is decided when
//!    its closest certain hit lies before everything that was left open.
//! 2. [`second`]: the walk of a ray that is not decided, in `f64` with the same certificates; what they leave open is decided
//!    on the spot, in sums of two `f64`, and at last by exact arithmetic ([`resolve`]).
//! 3. [`values`]: `t`, `u` and `v` of the hit in `f64` with their errors; where those leave two `f32` to choose between, in
//!    sums of two `f64`, and at last exactly.

#[cfg(test)]
mod adversary;
pub(crate) mod resolve;
mod ring;
pub(crate) mod second;
mod values;
mod wide;

pub(crate) use values::round;
