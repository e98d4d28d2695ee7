//! Twins of `shaders/bvh/`.

pub(crate) mod slab;
pub(crate) mod traverse;
