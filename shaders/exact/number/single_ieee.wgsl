// What rounding to nearest loses at most, where the fingerprint shows that arithmetic is IEEE: 2^-24.
const UNIT: f32 = 5.960464477539063e-8;
