//! Twins of `shaders/leaf/`.

pub(crate) mod single;
pub(crate) mod spheres;
pub(crate) mod triangles;
pub(crate) mod word;
