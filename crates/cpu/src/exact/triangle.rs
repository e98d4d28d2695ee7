//! Twin of `shaders/exact/triangle.wgsl` (in `f32`, four abreast) and of `shaders/exact/wide/triangle.wgsl`.

use crate::lanes::Corners;
use crate::number::{Number, Vector, cross3, dot3};

/// A ray as certificates of triangles take it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<N> {
    pub(crate) origin: Vector<N>,
    pub(crate) direction: Vector<N>,
    /// `20 u (|d_x| + |d_y| + |d_z|)`.
    pub(crate) side_error: N,
    /// `54 u`.
    pub(crate) plane_error: N,
    /// More than all that underflows.
    pub(crate) tiny: N,
    /// `8 u`.
    pub(crate) round_error: N,
}

/// The three edge functions and what they may be off by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sides<N> {
    p: Vector<N>,
    n: Vector<N>,
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
    let n = cross3(e2, e1);
    let r = cross3(p, ray.direction);
    let determinant = dot3(n, ray.direction);
    let u = dot3(r, e2);
    let v = dot3(r, e1);
    let w = determinant - u - v;
    let far = p.largest();
    let side = ray.side_error * edge;
    let bound = side * far + ray.tiny;
    let bound_determinant = side * edge + ray.tiny;
    let bound_w = bound + bound + bound_determinant;
    Sides { p, n, far, u, v, w, determinant, bound, bound_w, bound_determinant }
}

/// Whether the line certainly misses: two edge functions have opposite signs.
#[inline(always)]
pub(crate) fn misses<N: Number>(s: &Sides<N>) -> N::Mask {
    let zero = N::constant(0.0);
    let low = (s.u.min(s.v) + s.bound).min(s.w + s.bound_w);
    let high = (s.u.max(s.v) - s.bound).max(s.w - s.bound_w);
    low.less(zero) & zero.less(high)
}

/// Whether the line certainly passes through the inside: all three have one sign.
#[inline(always)]
pub(crate) fn crosses<N: Number>(s: &Sides<N>) -> N::Mask {
    let zero = N::constant(0.0);
    let low = (s.u.min(s.v) - s.bound).min(s.w - s.bound_w);
    let high = (s.u.max(s.v) + s.bound).max(s.w + s.bound_w);
    zero.less(low) | high.less(zero)
}

/// `t` of the point in the plane and what it may be off by; the mask holds where the determinant is clear of zero.
#[inline(always)]
pub(crate) fn plane_t<N: Number>(ray: &Line<N>, s: &Sides<N>, edge: N) -> (N::Mask, N, N) {
    let size = s.determinant.abs();
    let clear = (s.bound_determinant * N::constant(4.0)).less(size);
    let inverse = N::constant(1.0) / N::select(clear, s.determinant, N::constant(1.0));
    let t = dot3(s.n, s.p) * inverse;
    let bound = ray.plane_error * edge * edge * s.far + ray.tiny;
    let off = (bound + t.abs() * s.bound_determinant) * inverse.abs() * N::constant(1.375) + t.abs() * ray.round_error;
    (clear, t, off)
}

/// `u` or `v` and what it may be off by, where the determinant is clear of zero.
#[inline(always)]
pub(crate) fn weight<N: Number>(ray: &Line<N>, s: &Sides<N>, numerator: N) -> (N, N) {
    let inverse = N::constant(1.0) / s.determinant;
    let x = numerator * inverse;
    let off =
        (s.bound + x.abs() * s.bound_determinant) * inverse.abs() * N::constant(1.375) + x.abs() * ray.round_error;
    (x, off)
}
