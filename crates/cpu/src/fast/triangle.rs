//! Twin of `shaders/fast/triangle.wgsl`, four triangles abreast.

use glam::Vec4;

use crate::batch::TierRay;
use crate::lanes::{Candidates, NO_HITS, Triangles4, Vec3x4, cross3, dot3};

#[inline(always)]
pub(crate) fn intersect_triangle(ray: &TierRay, &Triangles4 { a, b, c, .. }: &Triangles4) -> Candidates {
    let direction = Vec3x4::splat(ray.direction);
    let p = a - Vec3x4::splat(ray.origin);
    let e1 = a - b;
    let e2 = c - a;
    let n = cross3(e2, e1);
    let r = cross3(p, direction);
    let determinant = dot3(n, direction);
    let sign = Vec4::select(determinant.cmplt(Vec4::ZERO), Vec4::NEG_ONE, Vec4::ONE);
    let scale = sign * determinant;
    let u = sign * dot3(r, e2);
    let v = sign * dot3(r, e1);
    let inside = u.cmpge(Vec4::ZERO) & v.cmpge(Vec4::ZERO) & (u + v).cmple(scale) & scale.cmpgt(Vec4::ZERO);
    if !inside.any() {
        return NO_HITS;
    }
    let t = sign * dot3(n, p) / scale;
    let hits = inside & t.cmpge(Vec4::splat(ray.t_min)) & t.cmple(Vec4::splat(ray.t_max));
    Candidates { hits: hits.bitmask(), t, u: u / scale, v: v / scale }
}
