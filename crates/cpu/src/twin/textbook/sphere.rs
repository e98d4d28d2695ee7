//! Twin of `shaders/textbook/sphere.wgsl`.

use glam::Vec3A;
use rayproof_scene::Sphere;

use crate::twin::leaf::single::{Candidate, NO_HIT, SingleRay};
use crate::twin::math::dot3;

#[inline(always)]
pub(crate) fn intersect_sphere(ray: &SingleRay, &Sphere { center, radius }: &Sphere) -> Candidate {
    let o = ray.origin - Vec3A::from(center);
    let a = dot3(ray.direction, ray.direction);
    let b = 2.0 * dot3(ray.direction, o);
    let c = dot3(o, o) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if !(discriminant >= 0.0 && a > 0.0) {
        return NO_HIT;
    }
    let root = discriminant.sqrt();
    let near = (-b - root) / (2.0 * a);
    let far = (-b + root) / (2.0 * a);
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate { hit: true, t: near, u: 0.0, v: 0.0 };
    }
    Candidate { hit: far >= ray.t_min && far <= ray.t_max, t: far, u: 0.0, v: 0.0 }
}
