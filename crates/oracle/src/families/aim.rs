//! Aiming: from a target in `f64` to the nearest `f32` ray, and from whole numbers to exact ones.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Sphere, Triangle};

use super::Case;
use super::draw::{Draw, Turn};

/// The nearest `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what it is for")]
pub(super) fn round(x: f64) -> f32 {
    x as f32
}

/// `x` moved by `n` representable values, up or down.
pub(super) fn ulps(x: f32, n: i32) -> f32 {
    (0..n.abs()).fold(x, |x, _| if n > 0 { x.next_up() } else { x.next_down() })
}

/// The case of one sphere.
pub(super) fn on_sphere(sphere: Sphere, rays: usize, ray: impl FnMut() -> Ray) -> Case {
    on(vec![Geometry::Spheres(vec![sphere])], rays, ray)
}

/// The case of one mesh.
pub(super) fn on_mesh(mesh: Mesh, rays: usize, ray: impl FnMut() -> Ray) -> Case {
    on(vec![Geometry::Mesh(mesh)], rays, ray)
}

/// The case of these geometries.
pub(super) fn on(geometries: Vec<Geometry>, rays: usize, mut ray: impl FnMut() -> Ray) -> Case {
    Case { rays: (0..rays).map(|_| ray()).collect(), scene: Scene::new(geometries).expect("made of finite numbers") }
}

/// The mesh of these triangles, which share no vertices.
pub(super) fn soup(triangles: &[Triangle]) -> Mesh {
    let vertices: Vec<Vec3> = triangles.iter().flat_map(|t| [t.a, t.b, t.c]).collect();
    let mut corner = 0_u32..;
    let triangles = triangles.iter().map(|_| [0; 3].map(|_| corner.next().unwrap_or(0))).collect();
    Mesh { vertices, triangles }
}

/// The ray from `origin` to a target, its direction `length` long before it is rounded.
pub(super) fn toward(origin: Vec3, target: DVec3, length: f64) -> Ray {
    along(origin, (target - origin.as_dvec3()).normalize_or(DVec3::X) * length)
}

/// The ray from `origin` whose direction is the rounded `direction`, or the x axis where that is zero.
pub(super) fn along(origin: Vec3, direction: DVec3) -> Ray {
    let direction = direction.as_vec3();
    Ray::new(origin, if direction == Vec3::ZERO { Vec3::X } else { direction })
}

/// This ray over another range.
pub(super) fn within(ray: Ray, t_min: f32, t_max: f32) -> Ray {
    Ray { t_min, t_max, ..ray }
}

/// The ray with its axes permuted and mirrored.
pub(super) fn turned(turn: Turn, ray: Ray) -> Ray {
    Ray { origin: turn.apply(ray.origin), direction: turn.apply(ray.direction), ..ray }
}

/// The triangle with its axes permuted and mirrored.
pub(super) fn turned_triangle(turn: Turn, t: Triangle) -> Triangle {
    Triangle { a: turn.apply(t.a), b: turn.apply(t.b), c: turn.apply(t.c) }
}

/// A ray that starts `distance` from a point and passes it at `impact`, as near as `f32` allows in any direction.
pub(super) fn passing(draw: &mut Draw, center: Vec3, distance: f64, impact: f64, length: f64) -> Ray {
    let origin = (center.as_dvec3() + draw.unit() * distance).as_vec3();
    let o = origin.as_dvec3() - center.as_dvec3();
    let sin = (impact / o.length()).clamp(-1.0, 1.0);
    let inward = -o.normalize_or(DVec3::X);
    let direction = inward * (1.0 - sin * sin).sqrt() + draw.across(inward) * sin;
    along(origin, direction * length)
}

/// A ray that starts about `distance` (a factor of 2) from zero and passes it at exactly `impact`.
///
/// In a coordinate plane `e = -m d` is exact for short whole numbers, and the third axis holds the impact alone.
/// A `slant` of that axis (at most about the impact) keeps the impact to an ulp or two, and no longer in a plane.
pub(super) fn passing_exactly(draw: &mut Draw, distance: f64, impact: f32, slant: f64) -> Ray {
    let (x, y, m) = (draw.whole(1, 2047), draw.whole(0, 2047), draw.whole(1, 4095));
    let place = (distance / (m * x.hypot(y))).log2().round().exp2();
    let length = draw.power(-4, 4);
    let t = m * place / length;
    let z = round(slant / t);
    // Where it passes, the height over the plane is the impact over the cosine of the slant.
    let rise = f64::from(z) * t;
    let height = round(f64::from(impact) * (rise / (m * place * x.hypot(y))).hypot(1.0) - rise);
    let origin = DVec3::new(-m * x * place, -m * y * place, f64::from(height));
    let turn = draw.turn();
    turned(turn, along(origin.as_vec3(), DVec3::new(x * length, y * length, f64::from(z))))
}

/// A point of a triangle of the mesh: a vertex, a point of an edge, or of the inside, a third each.
pub(super) fn point_of(draw: &mut Draw, mesh: &Mesh) -> DVec3 {
    let triangle = mesh.triangle(draw.below(mesh.triangles.len()));
    let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|p| p.as_dvec3());
    let [a, b, c] = draw.pick(&[[a, b, c], [b, c, a], [c, a, b]]);
    match draw.below(3) {
        0 => a,
        1 => a + (b - a) * draw.range(0.0, 1.0),
        _ => {
            let (u, v) = (draw.range(0.0, 1.0), draw.range(0.0, 1.0));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            a + (b - a) * u + (c - a) * v
        }
    }
}

/// A ray at a point of the mesh; one in eight goes by, up to `spread` away from that point.
pub(super) fn at_mesh(draw: &mut Draw, mesh: &Mesh, origin: Vec3, spread: f64, length: f64) -> Ray {
    let mut target = point_of(draw, mesh);
    if draw.chance(0.125) {
        target += draw.unit() * draw.range(0.0, spread);
    }
    toward(origin, target, length)
}
