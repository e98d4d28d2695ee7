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

// x 2^n, n held within -252 and 252: exact, or where it is subnormal the nearest. By the bits of x and of the result, so that
// neither is lost on a device that takes subnormals for 0.
fn scale_by_power(x: f32, n: i32) -> f32 {
    let bits = bitcast<u32>(x);
    let sign = bits & 0x80000000u;
    var size = bits & 0x7fffffffu;
    if size == 0u || size >= 0x7f800000u {
        return x;
    }
    var by = clamp(n, -252, 252);
    if size < 0x00800000u {
        // size 2^-149; as a whole number it is normal.
        size = bitcast<u32>(f32(size));
        by -= 149;
    }
    let exponent = i32(size >> 23u) + by;
    if exponent >= 255 {
        return bitcast<f32>(sign | 0x7f800000u);
    }
    if exponent > 0 {
        return bitcast<f32>(sign | (size + (bitcast<u32>(by) << 23u)));
    }
    return bitcast<f32>(sign | shifted((size & 0x007fffffu) | 0x00800000u, u32(min(1 - exponent, 25))));
}

// x 2^-n, n at least 1, as the nearest whole number, ties to even.
fn shifted(x: u32, n: u32) -> u32 {
    let kept = x >> n;
    let rest = x & ((1u << n) - 1u);
    let half = 1u << (n - 1u);
    return kept + u32(rest > half || (rest == half && (kept & 1u) == 1u));
}

fn scale_point(p: vec3<f32>, n: i32) -> vec3<f32> {
    return vec3<f32>(scale_by_power(p.x, n), scale_by_power(p.y, n), scale_by_power(p.z, n));
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

// 0 has one sign in answers; and what a device compares as 0, so that a subnormal just below 0 passes for inside, is 0.
fn without_sign(x: f32) -> f32 {
    return select(x, 0.0, x == 0.0);
}
