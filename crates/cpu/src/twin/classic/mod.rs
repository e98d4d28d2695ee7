//! Twins of `shaders/classic/`.
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    clippy::manual_range_contains,
    reason = "comparisons as the kernel writes them, so that a NaN is rejected alike"
)]

mod ray;
mod sphere;
mod triangle;

pub(crate) use ray::prepared_ray;
pub(crate) use sphere::intersect_sphere;
pub(crate) use triangle::intersect_triangle;
