//! Twin of `shaders/exact/number/pair_of_f64.wgsl`.

/// What one operation is off by at most, relative to its result.
pub(crate) const UNIT: f32 = f32::from_bits((127 - 100) << 23);
