// Numbers for what f64 cannot round: pairs of f64.
alias Part = f64;

const SPLITTER: f64 = 134217729.0lf; // 2^27 + 1

// More than 16 v^2 with v = 2^-52, as number/double.wgsl takes it.
const UNIT: f32 = 7.888609052210118e-31; // 2^-100
