//! Twin of `shaders/exact/number/double.wgsl`. A processor rounds to nearest: half of what the kernel allows for.

/// What rounding to nearest loses at most, relative to the result.
pub(crate) const UNIT: f32 = f32::from_bits((127 - 53) << 23);
