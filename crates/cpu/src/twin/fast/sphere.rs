//! Twin of `shaders/fast/sphere.wgsl`.

use glam::Vec3A;
use rayproof_scene::Sphere;

use crate::twin::leaf::single::{Candidate, NO_HIT, SingleRay};
use crate::twin::math::dot3;

#[inline(always)]
pub(crate) fn intersect_sphere(ray: &SingleRay, &Sphere { center, radius }: &Sphere) -> Candidate {
    let o = ray.origin - Vec3A::from(center);
    let a = dot3(ray.direction, ray.direction);
    let b = dot3(ray.direction, o);
    let l = o - (b / a) * ray.direction;
    let discriminant = a * (radius * radius - dot3(l, l));
    if !(discriminant >= 0.0) {
        return NO_HIT;
    }
    let root = discriminant.sqrt();
    let q = -(b + if b >= 0.0 { root } else { -root });
    let t1 = q / a;
    let t2 = if q == 0.0 { t1 } else { (dot3(o, o) - radius * radius) / q };
    let (near, far) = if t1 < t2 { (t1, t2) } else { (t2, t1) };
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate { hit: true, t: near, u: 0.0, v: 0.0 };
    }
    Candidate { hit: far >= ray.t_min && far <= ray.t_max, t: far, u: 0.0, v: 0.0 }
}
