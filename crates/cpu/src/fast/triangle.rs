//! Twin of `shaders/fast/triangle.wgsl`.

use rayproof_scene::bvh::PackedTriangle;

use crate::batch::{Candidate, NO_HIT, TierRay};
use crate::math::{cross3, dot3};

#[inline(always)]
pub(crate) fn intersect_triangle(ray: &TierRay, &PackedTriangle { a, b, c, .. }: &PackedTriangle) -> Candidate {
    let p = a - ray.origin;
    let e1 = a - b;
    let e2 = c - a;
    let n = cross3(e2, e1);
    let r = cross3(p, ray.direction);
    let determinant = dot3(n, ray.direction);
    let sign = if determinant < 0.0 { -1.0 } else { 1.0 };
    let scale = sign * determinant;
    let u = sign * dot3(r, e2);
    let v = sign * dot3(r, e1);
    if !(u >= 0.0 && v >= 0.0 && u + v <= scale && scale > 0.0) {
        return NO_HIT;
    }
    let t = sign * dot3(n, p) / scale;
    Candidate { hit: t >= ray.t_min && t <= ray.t_max, t, u: u / scale, v: v / scale }
}
