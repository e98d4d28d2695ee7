//! The CPU's own walk, for the precision `exact`: a tree of eight children a node, the eight boxes tested at once.
//!
//! Kernels have no twin of it. What it finds is not its own, though: the arithmetic of a box is that of `shaders/bvh/slab.wgsl` and
//! that of a leaf the first stage's, so every bound that is derived there holds here, and which tree is walked changes no answer of
//! exact arithmetic. A primitive that `f32` leaves open is asked of `f64` on the spot ([`spot`]), by the bounds of the second stage.

mod engine;
mod isa;
mod node;
mod spot;
mod turns;
mod walk;

pub use self::engine::Exact;
