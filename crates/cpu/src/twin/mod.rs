//! Twins of the kernels: each file has the path and the names of its file in `shaders/` and does the same operations in the same
//! order. The derivations stand there. A house test lists the few kernels that have none, with the reasons.

pub(crate) mod batch;
pub(crate) mod bvh;
pub(crate) mod classic;
pub(crate) mod double;
pub(crate) mod exact;
pub(crate) mod fast;
pub(crate) mod leaf;
pub(crate) mod math;
pub(crate) mod textbook;
