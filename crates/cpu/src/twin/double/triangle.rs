//! Twin of `shaders/double/triangle.wgsl`, four triangles abreast.

use glam::Vec4;

use crate::f64x4::Double;
use crate::lanes::{Candidates, Corners, NO_HITS, Triangles4, splat};
use crate::twin::exact::number::Mask as _;
use crate::twin::exact::vector::{cross_n, dot_n};
use crate::twin::leaf::single::SingleRay;

#[inline(always)]
pub(crate) fn intersect_triangle<N: Double<Single = Vec4>>(ray: &SingleRay, triangles: &Triangles4) -> Candidates {
    let Corners { a, b, c, .. } = triangles.corners;
    let [a, b, c, d, origin] = [a, b, c, splat(ray.direction), splat(ray.origin)].map(|v| v.map(N::widen));
    let zero = N::constant(0.0);
    let p = a - origin;
    let e1 = a - b;
    let e2 = c - a;
    let normal = cross_n(e2, e1);
    let r = cross_n(p, d);
    let determinant = dot_n(normal, d);
    let negative = determinant.less(zero);
    let signed = |x: N| N::pick(x, zero - x, negative);
    let scale = signed(determinant);
    let u = signed(dot_n(r, e2));
    let v = signed(dot_n(r, e1));
    let outside = u.less(zero) | v.less(zero) | scale.less(u + v);
    let inside = (!(outside | !zero.less(scale))).bits();
    if inside == 0 {
        return NO_HITS;
    }
    let [t, u, v] = [signed(dot_n(normal, p)), u, v].map(|x| (x / scale).narrow());
    let in_range = t.cmpge(Vec4::splat(ray.t_min)) & t.cmple(Vec4::splat(ray.t_max));
    // What overflowed is no number, and no hit.
    let numbers = u.cmpge(Vec4::ZERO) & v.cmpge(Vec4::ZERO);
    let hits = inside & in_range.bitmask() & numbers.bitmask();
    Candidates { hits, t, u, v }
}
