//! Exact vectors: the stored `f32` numbers as rationals.

use dashu_ratio::Relaxed;
use glam::Vec3;
use rayproof_scene::Ray;

/// An exact number, not reduced to lowest terms: sums and products of `f32` stay dyadic, where reducing means only
/// dropping factors of two.
pub(crate) type Number = Relaxed;

/// Three exact numbers.
pub(crate) type Vector = [Number; 3];

/// The stored number, exactly. `x` is finite: [`Oracle`](crate::Oracle) lets nothing else through.
pub(crate) fn number(x: f32) -> Number {
    debug_assert!(x.is_finite());
    Number::try_from(x).unwrap_or(Number::ZERO)
}

/// The stored vector, exactly.
pub(crate) fn vector(v: Vec3) -> Vector {
    v.to_array().map(number)
}

pub(crate) fn sub(a: &Vector, b: &Vector) -> Vector {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

pub(crate) fn dot(a: &Vector, b: &Vector) -> Number {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    let component = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// The line of a ray, exactly.
pub(crate) struct Line {
    /// The origin `e`.
    pub(crate) e: Vector,
    /// The direction `d`.
    pub(crate) d: Vector,
    /// The two coordinate axes other than that of the largest component of `d`: the directions in which the tie rule
    /// of [`triangle`](crate::triangle) shifts the line.
    pub(crate) ties: [usize; 2],
}

impl Line {
    pub(crate) fn new(ray: &Ray) -> Self {
        let ties = other_axes(ray.direction);
        Self { e: vector(ray.origin), d: vector(ray.direction), ties }
    }
}

/// The axes `[i, j]` that are not the (first) largest component of `d`, in cyclic order after it.
pub(crate) fn other_axes(d: Vec3) -> [usize; 2] {
    let d = d.abs();
    if d.x >= d.y && d.x >= d.z {
        [1, 2]
    } else if d.y >= d.z {
        [2, 0]
    } else {
        [0, 1]
    }
}
