//! Twin of `shaders/double/sphere.wgsl`.

use glam::Vec3A;
use rayproof_scene::Sphere;

use crate::f64x4::Double;
use crate::twin::exact::number::Number;
use crate::twin::exact::vector::{Vector, dot_n};
use crate::twin::leaf::single::{Candidate, NO_HIT, SingleRay};

#[inline(always)]
pub(crate) fn intersect_sphere<N: Double<Single = f32> + Number<Mask = bool>>(
    ray: &SingleRay,
    &Sphere { center, radius }: &Sphere,
) -> Candidate {
    let v = |p: Vec3A| Vector::from(p.to_array()).map(N::widen);
    let zero = N::constant(0.0);
    let d = v(ray.direction);
    let o = v(ray.origin) - v(center.into());
    let a = dot_n(d, d);
    let b = dot_n(d, o);
    let foot = b / a;
    let l = Vector { x: o.x - foot * d.x, y: o.y - foot * d.y, z: o.z - foot * d.z };
    let r2 = N::widen(radius) * N::widen(radius);
    let discriminant = a * (r2 - dot_n(l, l));
    if discriminant.less(zero) {
        return NO_HIT;
    }
    let h = discriminant.sqrt();
    let q = zero - N::pick(b + h, b - h, b.less(zero));
    let t1 = (q / a).narrow();
    let t2 = if q.less(zero) || zero.less(q) { ((dot_n(o, o) - r2) / q).narrow() } else { t1 };
    let (near, far) = if t1 < t2 { (t1, t2) } else { (t2, t1) };
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate { hit: true, t: near, u: 0.0, v: 0.0 };
    }
    Candidate { hit: far >= ray.t_min && far <= ray.t_max, t: far, u: 0.0, v: 0.0 }
}
