//! The bounding volume hierarchy that engines walk: four children a node and boxes on an exact grid, or eight and boxes as they are.
//!
//! Which primitives lie together is decided by the surface area heuristic, in time linear in them whatever they are; what counts
//! for the answers is that boxes are conservative:
//!
//! * A leaf's box is the exact box of its triangles, or of its spheres rounded outward.
//! * A node of four stores its children's boxes as bytes on a grid `origin + q step`, `step` a power of two and `origin` a
//!   multiple of it no larger than `2^24 step`, so decoding is exact in `f32`: nothing but the slab test can round, and
//!   `shaders/bvh/slab.wgsl` derives the pad that covers it.
//!
#![doc = include_str!("../README.md")]

mod build;
mod bvh;
mod node;
mod pack;
mod topology;

pub use bvh::{Bvh, Scaling, TooLarge};
pub use node::{COUNT_SHIFT, Child, EMPTY, EightBoxes, INDEX_MASK, KIND_MASK, KIND_SHIFT, LEAF, Node};
pub use pack::{Originals, PackedTriangle};
