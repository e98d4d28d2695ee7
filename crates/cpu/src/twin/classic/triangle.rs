//! Twin of `shaders/classic/triangle.wgsl`, four triangles abreast.

use glam::Vec4;

use crate::lanes::{Candidates, Corners, NO_HITS, Triangles4, splat};
use crate::twin::leaf::single::SingleRay;
// Those of `shaders/math.wgsl`, four lanes abreast.
use crate::twin::exact::vector::{cross_n as cross3, dot_n as dot3};

#[inline(always)]
pub(crate) fn intersect_triangle(ray: &SingleRay, triangles: &Triangles4) -> Candidates {
    let Corners { a, b, c, .. } = triangles.corners;
    let direction = splat(ray.direction);
    let e1 = b - a;
    let e2 = c - a;
    let s = splat(ray.origin) - a;
    let p = cross3(e2, e1);
    let determinant = dot3(direction, p);
    let m = cross3(direction, s);
    let v = dot3(e1, m) / determinant;
    let inside = determinant.cmpne(Vec4::ZERO) & v.cmpge(Vec4::ZERO) & v.cmple(Vec4::ONE);
    if !inside.any() {
        return NO_HITS;
    }
    let u = -dot3(e2, m) / determinant;
    let inside = inside & u.cmpge(Vec4::ZERO) & u.cmple(Vec4::ONE - v);
    if !inside.any() {
        return NO_HITS;
    }
    let t = -dot3(s, p) / determinant;
    let hits = inside & t.cmpge(Vec4::splat(ray.t_min)) & t.cmple(Vec4::splat(ray.t_max));
    Candidates { hits: hits.bitmask(), t, u, v }
}
