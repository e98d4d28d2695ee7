// Numbers of the second stage where the device has them. Vulkan asks for correctly rounded sums and products, a quotient within
// 2.5 ULP, and a square root as by 1/inverseSqrt; a trial on the device looks at all four.
alias N = f64;

// Twice what rounding to nearest loses: 2^-52.
const UNIT: f32 = 2.220446049250313e-16;

// A nearby f32, within 2^-22.
fn about(x: N) -> f32 { return narrow(x); }
// At least x, and near it.
fn above(x: N) -> f32 { return about(x) + abs(about(x)) * 2.384185791015625e-7; } // 2^-22
