// Numbers of the second stage where f64 is missing or dearer: pairs of f32.
alias Part = f32;

const SPLITTER: f32 = 4097.0; // 2^12 + 1

// 8 v^2 with v = 2^-24: a quotient or a root is within twice that, where bounds allow for 2.5 and 4.5 times.
const UNIT: f32 = 2.842170943040401e-14; // 2^-45

// The f32 itself.
fn narrow(x: f32) -> f32 { return x; }
