// What rounding to nearest loses at most, where the fingerprint shows that sums, products and quotients do: 2^-24.
const UNIT: f32 = 5.960464477539063e-8;
