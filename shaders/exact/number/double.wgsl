// Numbers of the second tier where the device has them: f64. Vulkan asks for correctly rounded sums and products, a quotient
// within 2.5 ULP, and a square root as by 1/inverseSqrt; the fingerprint looks at all four.
alias N = f64;

// Twice what rounding to nearest loses: 2^-52.
const UNIT: f32 = 2.220446049250313e-16;

fn n(x: f32) -> N { return f64(x); }
fn add(a: N, b: N) -> N { return a + b; }
fn sub(a: N, b: N) -> N { return a - b; }
fn mul(a: N, b: N) -> N { return a * b; }
fn div(a: N, b: N) -> N { return a / b; }
fn root(a: N) -> N { return sqrt(a); }
fn size(a: N) -> N { return abs(a); }
fn less(a: N, b: N) -> bool { return a < b; }
fn smaller(a: N, b: N) -> N { return min(a, b); }
fn larger(a: N, b: N) -> N { return max(a, b); }
fn pick(no: N, yes: N, which: bool) -> N { return select(no, yes, which); }

// A nearby f32, within 2^-22.
fn about(x: N) -> f32 { return f32(x); }
// At least x, and near it.
fn above(x: N) -> f32 { return about(x) + abs(about(x)) * 2.384185791015625e-7; } // 2^-22
