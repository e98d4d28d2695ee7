//! Twin of `shaders/math.wgsl`.

use glam::{BVec3A, Vec3A};

/// WGSL's `select`. (glam's takes the mask first and `yes` before `no`.)
#[inline(always)]
pub(crate) fn select(no: Vec3A, yes: Vec3A, mask: BVec3A) -> Vec3A {
    Vec3A::select(mask, yes, no)
}

#[inline(always)]
pub(crate) fn dot3(a: Vec3A, b: Vec3A) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

#[inline(always)]
#[expect(clippy::cast_sign_loss, reason = "n is at least -126")]
pub(crate) const fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}

/// The kernel goes by the bits, since a device may take subnormals for 0. Here `f64` holds the product, which is rounded once.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the nearest")]
#[expect(clippy::cast_sign_loss, reason = "n is at least -252")]
pub(crate) fn scale_by_power(x: f32, n: i32) -> f32 {
    let power = f64::from_bits(((n.clamp(-252, 252) + 1023) as u64) << 52);
    (f64::from(x) * power) as f32
}

#[inline(always)]
pub(crate) fn scale_point(p: Vec3A, n: i32) -> Vec3A {
    Vec3A::from(p.to_array().map(|x| scale_by_power(x, n)))
}

#[inline(always)]
#[expect(clippy::cast_possible_wrap, reason = "nine bits")]
pub(crate) const fn exponent_of(x: f32) -> i32 {
    (x.to_bits() >> 23) as i32 - 127
}

#[inline(always)]
pub(crate) fn largest(v: Vec3A) -> f32 {
    v.abs().max_element()
}

#[inline(always)]
pub(crate) fn scale_low_end(x: f32, n: i32) -> f32 {
    let y = scale_by_power(x, n);
    match y.abs() < f32::MIN_POSITIVE && x != 0.0 {
        true if x > 0.0 => f32::MIN_POSITIVE,
        true => 0.0,
        false => y,
    }
}

#[inline(always)]
pub(crate) fn scale_high_end(x: f32, n: i32) -> f32 {
    let y = scale_by_power(x, n);
    match y.abs() < f32::MIN_POSITIVE && x != 0.0 {
        true if x < 0.0 => -f32::MIN_POSITIVE,
        true => 0.0,
        false => y,
    }
}

#[inline(always)]
pub(crate) fn without_sign(x: f32) -> f32 {
    if x == 0.0 { 0.0 } else { x }
}
