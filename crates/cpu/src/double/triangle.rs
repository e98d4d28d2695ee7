//! Twin of `shaders/double/triangle.wgsl`, four triangles abreast.

use glam::Vec4;

use super::numbers::Double;
use crate::batch::SingleRay;
use crate::lanes::{Candidates, Corners, NO_HITS, Triangles4, splat};
use crate::number::{Mask as _, cross3, dot3};

#[inline(always)]
pub(crate) fn intersect_triangle<N: Double<Single = Vec4>>(ray: &SingleRay, triangles: &Triangles4) -> Candidates {
    let Corners { a, b, c, .. } = triangles.corners;
    let [a, b, c, d, origin] = [a, b, c, splat(ray.direction), splat(ray.origin)].map(|v| v.map(N::widen));
    let zero = N::constant(0.0);
    let p = a - origin;
    let e1 = a - b;
    let e2 = c - a;
    let normal = cross3(e2, e1);
    let r = cross3(p, d);
    let determinant = dot3(normal, d);
    let negative = determinant.less(zero);
    let signed = |x: N| N::select(negative, zero - x, x);
    let scale = signed(determinant);
    let u = signed(dot3(r, e2));
    let v = signed(dot3(r, e1));
    let outside = u.less(zero) | v.less(zero) | scale.less(u + v);
    let inside = (!(outside | !zero.less(scale))).bits();
    if inside == 0 {
        return NO_HITS;
    }
    let t = (signed(dot3(normal, p)) / scale).narrow();
    let in_range = t.cmpge(Vec4::splat(ray.t_min)) & t.cmple(Vec4::splat(ray.t_max));
    let hits = inside & in_range.bitmask();
    Candidates { hits, t, u: (u / scale).narrow(), v: (v / scale).narrow() }
}
