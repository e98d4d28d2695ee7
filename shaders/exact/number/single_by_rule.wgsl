// What Vulkan and WGSL let a sum or a product lose: 2^-23.
const UNIT: f32 = 1.1920928955078125e-7;
