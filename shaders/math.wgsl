// Sums and products spelled out, so that every device and the CPU do them in one order.

fn dot3(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

fn cross3(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// 2^n for -126 <= n <= 127, by its bits: exp2 is allowed 3 + 2|n| ULP.
fn power_of_two(n: i32) -> f32 {
    return bitcast<f32>(u32(n + 127) << 23u);
}

// x 2^n in two steps, exact unless the result is subnormal or overflows. n is held within -252 and 252.
fn scale_by_power(x: f32, n: i32) -> f32 {
    let m = clamp(n, -252, 252);
    let half = m >> 1u;
    return x * power_of_two(half) * power_of_two(m - half);
}

// floor(log2 x) of a normal x > 0.
fn exponent_of(x: f32) -> i32 {
    return i32(bitcast<u32>(x) >> 23u) - 127;
}

fn largest(v: vec3<f32>) -> f32 {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// Whether x is 0, of either sign, by its bits: a device may take a subnormal for 0 where it compares, and keep it elsewhere
// (NVIDIA's do).
fn is_zero(x: f32) -> bool {
    return (bitcast<u32>(x) << 1u) == 0u;
}

// Whether x, no NaN, is below zero, by its bits too.
fn is_negative(x: f32) -> bool {
    return (bitcast<u32>(x) >> 31u) == 1u && !is_zero(x);
}

// The ends of a range scaled by 2^n, rounded inward where they become subnormal, so that what lies in the scaled range
// lies in the given one.
fn scale_low_end(x: f32, n: i32) -> f32 {
    let y = scale_by_power(x, n);
    return select(y, select(SMALLEST_NORMAL, 0.0, is_negative(x)), abs(y) < SMALLEST_NORMAL && !is_zero(x));
}

fn scale_high_end(x: f32, n: i32) -> f32 {
    let y = scale_by_power(x, n);
    return select(y, select(0.0, -SMALLEST_NORMAL, is_negative(x)), abs(y) < SMALLEST_NORMAL && !is_zero(x));
}

const SMALLEST_NORMAL: f32 = 1.1754943508222875e-38; // 2^-126

// 0 has one sign in answers; and where a device compares a subnormal as 0, so that one just below 0 passed for inside, it is 0.
fn without_sign(x: f32) -> f32 {
    return select(x, 0.0, x == 0.0);
}
