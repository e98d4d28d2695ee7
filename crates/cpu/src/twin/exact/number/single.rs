//! Twin of `shaders/exact/number/single.wgsl`, with the roundoff of `single_ieee.wgsl`.

/// What rounding to nearest loses at most, relative to the result.
pub(crate) const UNIT: f32 = f32::from_bits((127 - 24) << 23);
