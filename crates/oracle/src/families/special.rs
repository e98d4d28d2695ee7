//! Family 37 and what is beyond it: the ends of f32 in every slot, and the values that no slot may hold.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Ray, Sphere, Triangle};

use super::Case;
use super::aim::{along, at_mesh, on, passing, round, soup, toward};
use super::draw::Draw;

const TINY: f32 = f32::from_bits(1);
/// Valid everywhere (a radius takes the ones that are not below zero): zeros, subnormals, both ends of the normals.
const ENDS: [f32; 14] = [
    0.0,
    -0.0,
    TINY,
    -TINY,
    1e-40,
    f32::MIN_POSITIVE.next_down(),
    -f32::MIN_POSITIVE,
    1e-30,
    1e30,
    -1e30,
    1.844_674_4e19,
    f32::MAX.next_down(),
    f32::MAX,
    f32::MIN,
];

/// 37: one slot of a ray, a sphere or a triangle at an end of f32; all slots subnormal; all slots near the largest.
pub(super) fn ends(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    if variant >= 3 {
        return all_at_one_end(draw, variant, rays);
    }
    let mut sphere = Sphere { center: Vec3::new(0.5, 0.25, 0.0), radius: 1.0 };
    let mut corners = [[-3.0, -3.0, -2.0], [3.0, -3.0, -2.0], [0.0, 3.0, -2.5]];
    let aim = soup(&[Triangle { a: corners[0].into(), b: corners[1].into(), c: corners[2].into() }]);
    let (value, slot) = (draw.pick(&ENDS), draw.below(9));
    match variant {
        1 if slot < 3 => sphere.center[slot] = value,
        1 => sphere.radius = if value < 0.0 { -value } else { value },
        2 => corners[slot / 3][slot % 3] = value,
        _ => {}
    }
    let mesh = soup(&[Triangle { a: corners[0].into(), b: corners[1].into(), c: corners[2].into() }]);
    on(vec![Geometry::Spheres(vec![sphere]), Geometry::Mesh(mesh)], rays, || {
        loop {
            let origin = (draw.unit() * draw.log(0.1, 10.0)).as_vec3();
            let mut ray = match draw.below(3) {
                0 => toward(origin, Vec3::new(0.5, 0.25, 0.0).as_dvec3() + draw.unit() * draw.range(0.0, 1.1), 1.0),
                1 => at_mesh(draw, &aim, origin, 3.0, 1.0),
                _ => along(origin, draw.unit() * draw.length()),
            };
            if variant == 0 {
                let value = draw.pick(&ENDS);
                match draw.below(8) {
                    slot @ 0..3 => ray.origin[slot] = value,
                    slot @ 3..6 => ray.direction[slot - 3] = value,
                    6 => ray.t_min = draw.pick(&[value, f32::INFINITY, f32::NEG_INFINITY]),
                    _ => ray.t_max = draw.pick(&[value, f32::NEG_INFINITY]),
                }
            }
            if ray.fault().is_none() {
                return ray;
            }
        }
    })
}

/// A sphere, a triangle and rays of one extreme magnitude.
fn all_at_one_end(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let size = if variant == 3 { draw.log(1e-43, 1e-38) } else { draw.log(0.1, 1.0) * 1e38 };
    let sphere = Sphere { center: (draw.unit() * size).as_vec3(), radius: round(size * draw.range(0.3, 1.0)) };
    let corners = [0; 3].map(|_| (draw.unit() * size * 3.0).as_vec3());
    let mesh = soup(&[Triangle { a: corners[0], b: corners[1], c: corners[2] }]);
    on(vec![Geometry::Spheres(vec![sphere]), Geometry::Mesh(mesh.clone())], rays, || {
        let r = f64::from(sphere.radius);
        let (distance, impact) = (r * draw.range(1.1, 2.3), r * draw.range(0.0, 1.1));
        let length = if draw.chance(0.5) { 1.0 } else { size };
        let ray = passing(draw, sphere.center, distance, impact, length);
        let origin = (draw.unit() * size).as_vec3();
        if draw.chance(0.5) { ray } else { at_mesh(draw, &mesh, origin, 0.0, length) }
    })
}

const QUIET: f32 = f32::from_bits(0x7fc0_0000);
const SIGNALLING: f32 = f32::from_bits(0x7fa0_0001);
const NEGATIVE: f32 = f32::from_bits(0xffc0_1234);

/// A labelled list: every slot times every value no finite slot may hold.
macro_rules! spoil {
    ($good:expr, $($name:literal => $($slot:tt).+),+ $(,)?) => {{
        let mut all = Vec::new();
        $(spoil!(@values all, $good, $name, $($slot).+; "quiet NaN" QUIET, "signalling NaN" SIGNALLING,
            "negative NaN" NEGATIVE, "infinity" f32::INFINITY, "minus infinity" f32::NEG_INFINITY);)+
        all
    }};
    (@values $all:ident, $good:expr, $name:literal, $($slot:tt).+; $($label:literal $value:expr),+) => {
        spoil!(@one $all, $good, $($slot).+; $(concat!($name, ": ", $label), $value;)+)
    };
    (@one $all:ident, $good:expr, $($slot:tt).+;) => {};
    (@one $all:ident, $good:expr, $($slot:tt).+; $label:expr, $value:expr; $($rest:tt)*) => {
        let mut bad = $good;
        bad.$($slot).+ = $value;
        $all.push(($label, bad));
        spoil!(@one $all, $good, $($slot).+; $($rest)*)
    };
}

/// Rays that are none, each with one slot (or the direction, or the range) at fault and a label that says which.
#[must_use]
pub fn invalid_rays() -> Vec<(&'static str, Ray)> {
    let good = Ray { origin: Vec3::new(0.0, 0.0, 5.0), t_min: 0.0, direction: Vec3::new(0.1, 0.2, -1.0), t_max: 10.0 };
    let mut all = spoil!(good,
        "origin x" => origin.x, "origin y" => origin.y, "origin z" => origin.z,
        "direction x" => direction.x, "direction y" => direction.y, "direction z" => direction.z);
    let range = |t_min, t_max| Ray { t_min, t_max, ..good };
    all.extend([
        ("direction: zero", Ray { direction: Vec3::ZERO, ..good }),
        ("direction: minus zero", Ray { direction: Vec3::new(-0.0, 0.0, -0.0), ..good }),
        ("t_min: quiet NaN", range(QUIET, 10.0)),
        ("t_min: signalling NaN", range(SIGNALLING, 10.0)),
        ("t_min: infinity", range(f32::INFINITY, 10.0)),
        ("t_max: quiet NaN", range(0.0, QUIET)),
        ("t_max: signalling NaN", range(0.0, SIGNALLING)),
        ("t_max: minus infinity", range(0.0, f32::NEG_INFINITY)),
        ("range: an ulp above t_max", range(10.0_f32.next_up(), 10.0)),
        ("range: a subnormal above t_max", range(TINY, 0.0)),
    ]);
    all
}

/// Spheres that are none, each with one slot at fault and a label that says which.
#[must_use]
pub fn invalid_spheres() -> Vec<(&'static str, Sphere)> {
    let good = Sphere { center: Vec3::new(1.0, 2.0, 3.0), radius: 0.5 };
    let mut all = spoil!(good,
        "center x" => center.x, "center y" => center.y, "center z" => center.z, "radius" => radius);
    all.extend([
        ("radius: minus one", Sphere { radius: -1.0, ..good }),
        ("radius: minus a subnormal", Sphere { radius: -TINY, ..good }),
        ("radius: minus the largest", Sphere { radius: f32::MIN, ..good }),
    ]);
    all
}

/// Triangles that are none, each with one slot at fault and a label that says which.
#[must_use]
pub fn invalid_triangles() -> Vec<(&'static str, Triangle)> {
    let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| p.as_vec3());
    spoil!(Triangle { a, b, c },
        "a.x" => a.x, "a.y" => a.y, "a.z" => a.z, "b.x" => b.x, "b.y" => b.y, "b.z" => b.z,
        "c.x" => c.x, "c.y" => c.y, "c.z" => c.z)
}
