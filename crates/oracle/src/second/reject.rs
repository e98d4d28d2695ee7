//! What a line surely misses, in `f64`: most primitives of a scene.
//!
//! `h = 2^-53`; nothing over- or underflows, as in the first oracle's filter. The weights `d.(s x e2)` and `d.(e1 x s)`
//! of Cramer's
//! rule have seven roundings a term (a difference in each of two factors, a product, a difference, a product, two sums), and
//! `det = d.(e1 x e2)` as many; a discriminant `b^2 - a c` at most fourteen. [`SLACK`] allows 32 relative to the sum of the
//! terms' absolute values, which covers those of the bounds too.

use glam::DVec3;
use rayproof_scene::{Ray, Sphere, Triangle};

/// `32 h`.
const SLACK: f64 = 16.0 * f64::EPSILON;

/// A triple product and a bound of its error.
fn triple(d: DVec3, p: DVec3, q: DVec3) -> (f64, f64) {
    let terms = |p: DVec3, q: DVec3| DVec3::new(p.y * q.z, p.z * q.x, p.x * q.y);
    let (plus, minus) = (terms(p, q), terms(q, p));
    (d.dot(plus - minus), SLACK * d.abs().dot(plus.abs() + minus.abs()))
}

/// Whether the line surely misses the triangle: two of the three weights have certain, opposite signs.
pub(super) fn misses_triangle(ray: &Ray, t: &Triangle) -> bool {
    let (e, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let [a, b, c] = [t.a, t.b, t.c].map(|v| v.as_dvec3());
    let (s, e1, e2) = (e - a, b - a, c - a);
    let (u, v, det) = (triple(d, s, e2), triple(d, e1, s), triple(d, e1, e2));
    let w = (det.0 - u.0 - v.0, 2.0 * (det.1 + u.1 + v.1));
    let signs = [u, v, w].map(|(x, bound)| u8::from(x > bound) | u8::from(x < -bound) << 1);
    signs[0] | signs[1] | signs[2] == 3
}

/// Whether the line surely misses the sphere: its discriminant is certainly negative.
pub(super) fn misses_sphere(ray: &Ray, s: &Sphere) -> bool {
    let (o, d, r) = (ray.origin.as_dvec3() - s.center.as_dvec3(), ray.direction.as_dvec3(), f64::from(s.radius));
    let (a, b, size) = (d.dot(d), o.dot(d), o.abs().dot(d.abs()));
    let c = o.dot(o) - r * r;
    b * b - a * c < -SLACK * (size * size + a * (o.dot(o) + r * r))
}
