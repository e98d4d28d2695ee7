//! Twins of `shaders/double/`, over the numbers that they run in; their rays are those of `fast`.

mod sphere;
mod triangle;

pub(crate) use sphere::intersect_sphere;
pub(crate) use triangle::intersect_triangle;
