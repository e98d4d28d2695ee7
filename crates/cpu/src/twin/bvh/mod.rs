//! Twins of `shaders/bvh/`.

pub(crate) mod every;
pub(crate) mod slab;
pub(crate) mod traverse;
