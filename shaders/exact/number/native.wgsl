// Numbers that the device has itself: f32 (number/single.wgsl) or f64 (number/double.wgsl). All that is written over `N` is
// written once and runs in every width.
fn n(x: f32) -> N { return N(x); }
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
// What an answer is written as.
fn to_f32(x: N) -> f32 { return f32(x); }
