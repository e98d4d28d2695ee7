//! The CPU's own walk, for the precision `exact`: a tree of eight children a node, the eight boxes tested at once.
//!
//! Kernels have no twin of it. What it finds is not its own, though: the arithmetic of a box is that of `shaders/bvh/slab.wgsl` and
//! that of a leaf the first stage's, so every bound that is derived there holds here, and which tree is walked changes no answer of
//! exact arithmetic.

mod engine;
mod isa;
mod node;
mod turns;
mod walk;

pub use self::engine::Exact;
