//! Twin of `shaders/textbook/`; its rays and triangles are those of `classic`.
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "comparisons as the kernel writes them, so that a NaN is rejected alike"
)]

mod sphere;

pub(crate) use sphere::intersect_sphere;
