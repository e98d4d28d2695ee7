//! The two single-precision methods whose roundings the judge counts, written straight from their formulas.

use glam::Vec3;
use rayproof_scene::{FlatHit, Primitive, Ray, Scene, Sphere, Triangle};

/// Moeller and Trumbore's method on origin-shifted vertices.
fn triangle(ray: &Ray, triangle: &Triangle) -> Option<[f32; 3]> {
    let Triangle { a, b, c } = *triangle;
    let (p, e1, e2) = (a - ray.origin, b - a, c - a);
    let (r, n) = (p.cross(ray.direction), e1.cross(e2));
    let det = n.dot(ray.direction);
    let sign = 1.0_f32.copysign(det);
    let (u, v, t) = (sign * r.dot(e2), -sign * r.dot(e1), sign * n.dot(p));
    let det = det.abs();
    let t_on_ray = t / det;
    let hit = det > 0.0 && u >= 0.0 && v >= 0.0 && u + v <= det && ray.t_min <= t_on_ray && t_on_ray <= ray.t_max;
    hit.then_some([t_on_ray, u / det, v / det])
}

/// Hearn and Baker's method with the root `c' / q`, on a direction scaled to about one by a power of two.
fn sphere(ray: &Ray, sphere: &Sphere) -> Option<[f32; 3]> {
    let largest = ray.direction.abs().max_element();
    let exponent = i32::try_from(largest.to_bits() >> 23).ok()? - 127;
    let scale = 2.0_f32.powi(-exponent);
    let d = ray.direction * scale;
    let o = ray.origin - sphere.center;
    let (a, b) = (d.dot(d), o.dot(d));
    let l = o - d * (b / a);
    let discriminant = a * (sphere.radius * sphere.radius - l.dot(l));
    if discriminant < 0.0 {
        return None;
    }
    let c = o.dot(o) - sphere.radius * sphere.radius;
    let q = -(b + discriminant.sqrt().copysign(b));
    // A ray from its own point of tangency: both roots are zero.
    let (x, y) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
    let roots = [x.min(y) * scale, x.max(y) * scale];
    roots.into_iter().find(|t| (ray.t_min..=ray.t_max).contains(t)).map(|t| [t, 0.0, 0.0])
}

/// The closest hit in single precision, by brute force.
pub(super) fn closest(scene: &Scene, ray: &Ray) -> FlatHit {
    hits(scene, ray).into_iter().fold(FlatHit::MISS, |old, new| if !old.is_hit() || new.t < old.t { new } else { old })
}

/// One hit a primitive.
pub(super) fn hits(scene: &Scene, ray: &Ray) -> Vec<FlatHit> {
    let hit = |flat: usize| {
        let [t, u, v] = match scene.primitive(flat) {
            Primitive::Triangle(shape) => triangle(ray, &shape),
            Primitive::Sphere(shape) => sphere(ray, &shape),
        }?;
        Some(FlatHit { t, u, v, primitive: u32::try_from(flat).ok()? })
    };
    (0..scene.len()).filter_map(hit).collect()
}

#[test]
fn it_is_the_method_it_says() {
    let unit = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y };
    let ray = Ray::new(Vec3::new(0.25, 0.5, 2.0), Vec3::NEG_Z);
    assert_eq!(triangle(&ray, &unit), Some([2.0, 0.25, 0.5]));
    let ball = Sphere { center: Vec3::ZERO, radius: 5.0 };
    assert_eq!(sphere(&Ray::new(Vec3::new(3.0, 0.0, 8.0), Vec3::NEG_Z * 0.25), &ball), Some([16.0, 0.0, 0.0]));
}
