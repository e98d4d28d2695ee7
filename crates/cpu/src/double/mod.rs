//! Twins of `shaders/double/`, over the numbers that they run in; their rays are those of `fast`.

mod numbers;
mod sphere;
mod triangle;

pub(crate) use numbers::F64x4;
pub(crate) use sphere::intersect_sphere;
pub(crate) use triangle::intersect_triangle;
