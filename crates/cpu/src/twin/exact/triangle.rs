//! Twin of `shaders/exact/triangle.wgsl`, where the bounds are derived; in `f32` four triangles abreast.

use super::line::Line;
use super::number::Number;
use super::vector::{Vector, cross_n, dot_n};
use crate::lanes::Corners;

/// The three edge functions and what they may be off by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides<N> {
    p: Vector<N>,
    normal: Vector<N>,
    far: N,
    pub(crate) u: N,
    pub(crate) v: N,
    w: N,
    pub(crate) determinant: N,
    /// The bound of `u` and `v`, that of `w`, and that of the determinant.
    pub(crate) bound: N,
    bound_w: N,
    pub(crate) bound_determinant: N,
}

#[inline(always)]
pub(crate) fn sides<N: Number>(ray: &Line<N>, &Corners { a, b, c, edge }: &Corners<N>) -> Sides<N> {
    let p = a - ray.origin;
    let e1 = a - b;
    let e2 = c - a;
    let normal = cross_n(e2, e1);
    let r = cross_n(p, ray.direction);
    let determinant = dot_n(normal, ray.direction);
    let u = dot_n(r, e2);
    let v = dot_n(r, e1);
    let w = determinant - u - v;
    let far = p.largest();
    let side = ray.side_error * edge;
    let bound = side * far + ray.tiny_triangle;
    let bound_determinant = side * edge + ray.tiny_triangle;
    let bound_w = bound + bound + bound_determinant;
    Sides { p, normal, far, u, v, w, determinant, bound, bound_w, bound_determinant }
}

/// Whether the line certainly misses: two edge functions have opposite signs.
#[inline(always)]
pub(crate) fn triangle_misses<N: Number>(s: &Sides<N>) -> N::Mask {
    let zero = N::constant(0.0);
    let low = (s.u.min(s.v) + s.bound).min(s.w + s.bound_w);
    let high = (s.u.max(s.v) - s.bound).max(s.w - s.bound_w);
    low.less(zero) & zero.less(high)
}

/// Whether the line certainly passes through the inside: all three have one sign.
#[inline(always)]
pub(crate) fn triangle_crosses<N: Number>(s: &Sides<N>) -> N::Mask {
    let zero = N::constant(0.0);
    let low = (s.u.min(s.v) - s.bound).min(s.w - s.bound_w);
    let high = (s.u.max(s.v) + s.bound).max(s.w + s.bound_w);
    zero.less(low) | high.less(zero)
}

/// A number and what it may be off by; neither means anything but where the determinant is clear of zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate<N: Number> {
    pub(crate) clear: N::Mask,
    pub(crate) value: N,
    pub(crate) off: N,
}

#[inline(always)]
pub(crate) fn quotient<N: Number>(ray: &Line<N>, s: &Sides<N>, numerator: N, bound: N) -> Estimate<N> {
    let clear = (s.bound_determinant * N::constant(4.0)).less(s.determinant.abs());
    let inverse = N::constant(1.0) / N::pick(N::constant(1.0), s.determinant, clear);
    let value = numerator * inverse;
    let relative = (bound + value.abs() * s.bound_determinant) * inverse.abs() * N::constant(1.375);
    Estimate { clear, value, off: relative + value.abs() * ray.round_error + ray.tiny_t }
}

#[inline(always)]
pub(crate) fn plane_t<N: Number>(ray: &Line<N>, s: &Sides<N>, edge: N) -> Estimate<N> {
    let bound = ray.plane_error * edge * edge * s.far + ray.tiny_triangle;
    quotient(ray, s, dot_n(s.normal, s.p), bound)
}
