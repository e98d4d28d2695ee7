//! Twins of `shaders/exact/`: certificates.

pub(crate) mod leaf;
pub(crate) mod line;
pub(crate) mod number;
pub(crate) mod ray;
pub(crate) mod sphere;
pub(crate) mod triangle;
pub(crate) mod vector;
