//! The geometric normal of a surface.

use glam::DVec3;

use crate::{FlatHit, Primitive, Scene};

/// The geometric normal of the primitive that was hit, at a point `p` of it, of any length.
///
/// # Panics
/// When the hit is a miss.
#[must_use]
pub fn normal(scene: &Scene, hit: &FlatHit, p: DVec3) -> DVec3 {
    match scene.primitive(hit.primitive as usize) {
        Primitive::Triangle(triangle) => {
            let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|v| v.as_dvec3());
            (b - a).cross(c - a)
        }
        Primitive::Sphere(sphere) => p - sphere.center.as_dvec3(),
    }
}

/// The unit normal on the side that a ray along `d` comes from.
#[must_use]
pub fn facing(normal: DVec3, d: DVec3) -> DVec3 {
    let back = -d.normalize();
    let normal = normal.try_normalize().unwrap_or(back);
    if normal.dot(back) < 0.0 { -normal } else { normal }
}
