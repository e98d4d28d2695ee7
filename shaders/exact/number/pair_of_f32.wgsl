// Numbers of the second stage where f64 is missing or dearer: pairs of f32.
alias Part = f32;

const SPLITTER: f32 = 4097.0; // 2^12 + 1

// 16 v^2 with v = 2^-24.
const UNIT: f32 = 5.684341886080802e-14; // 2^-44

// The f32 itself.
fn narrow(x: f32) -> f32 { return x; }
