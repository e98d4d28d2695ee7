//! Twin of `shaders/classic/triangle.wgsl`.

use rayproof_scene::bvh::PackedTriangle;

use crate::batch::{Candidate, NO_HIT, TierRay};
use crate::math::{cross3, dot3};

#[inline(always)]
pub(crate) fn intersect_triangle(ray: &TierRay, &PackedTriangle { a, b, c, .. }: &PackedTriangle) -> Candidate {
    let e1 = b - a;
    let e2 = c - a;
    let s = ray.origin - a;
    let p = cross3(e2, e1);
    let determinant = dot3(ray.direction, p);
    if determinant == 0.0 {
        return NO_HIT;
    }
    let m = cross3(ray.direction, s);
    let v = dot3(e1, m) / determinant;
    if !(v >= 0.0 && v <= 1.0) {
        return NO_HIT;
    }
    let u = -dot3(e2, m) / determinant;
    if !(u >= 0.0 && u <= 1.0 - v) {
        return NO_HIT;
    }
    let t = -dot3(s, p) / determinant;
    Candidate { hit: t >= ray.t_min && t <= ray.t_max, t, u, v }
}
