//! Twin of `shaders/fast/triangle.wgsl`, four triangles abreast.

use glam::Vec4;

use crate::lanes::{Candidates, Corners, NO_HITS, Triangles4, splat};
use crate::twin::exact::number::Number as _;
use crate::twin::leaf::single::SingleRay;
// Those of `shaders/math.wgsl`, four lanes abreast.
use crate::twin::exact::vector::{cross_n as cross3, dot_n as dot3};

#[inline(always)]
pub(crate) fn intersect_triangle(ray: &SingleRay, triangles: &Triangles4) -> Candidates {
    let Corners { a, b, c, .. } = triangles.corners;
    let direction = splat(ray.direction);
    let p = a - splat(ray.origin);
    let e1 = a - b;
    let e2 = c - a;
    let n = cross3(e2, e1);
    let r = cross3(p, direction);
    let determinant = dot3(n, direction);
    let sign = Vec4::pick(Vec4::ONE, Vec4::NEG_ONE, determinant.cmplt(Vec4::ZERO));
    let scale = sign * determinant;
    let u = sign * dot3(r, e2);
    let v = sign * dot3(r, e1);
    let inside = u.cmpge(Vec4::ZERO) & v.cmpge(Vec4::ZERO) & (u + v).cmple(scale) & scale.cmpgt(Vec4::ZERO);
    if !inside.any() {
        return NO_HITS;
    }
    let t = sign * dot3(n, p) / scale;
    let [u, v] = [u / scale, v / scale];
    let in_range = t.cmpge(Vec4::splat(ray.t_min)) & t.cmple(Vec4::splat(ray.t_max));
    // What overflowed is no number, and no hit.
    let hits = inside & in_range & u.cmpge(Vec4::ZERO) & v.cmpge(Vec4::ZERO);
    Candidates { hits: hits.bitmask(), t, u, v }
}
