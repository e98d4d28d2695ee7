//! Families 5 to 10: origins near, on and inside the surface, where `c' = o.o - r^2` or `b = d.o` cancels.

use glam::{DVec3, Vec3};
use rayproof_scene::{Ray, Sphere};

use super::Case;
use super::aim::{along, on_sphere, round, turned, within};
use super::draw::Draw;

/// A ray from just above a large sphere: a slope below the horizon, right at the horizon, or above it.
fn over_ground(draw: &mut Draw, sphere: Sphere, origin: Vec3) -> Ray {
    let (o, r) = (origin.as_dvec3() - sphere.center.as_dvec3(), f64::from(sphere.radius));
    let height = (o.length_squared() - r * r) / (o.length() + r);
    let up = o.normalize();
    let horizon = (2.0 * height.max(0.0) / r).sqrt();
    let slope = match draw.below(4) {
        0 => horizon * (1.0 + draw.sign() * draw.log(1e-6, 1e-1)),
        1 => draw.sign() * draw.log(1e-6, 1e-2),
        2 => horizon * draw.log(1.0, 100.0),
        _ => draw.log(1e-5, 1e-1),
    };
    let direction = (draw.across(up) - up * slope).normalize();
    along(origin, direction * draw.length())
}

/// 5: a ground sphere of radius 1e6, the eye 1e-3 to 100 above it, grazing slopes.
pub(super) fn ground(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e-3, 1e-2, 1.0, 100.0][variant];
    let radius = if draw.chance(0.5) { 1e6 } else { round(draw.around(1e6, 0.5)) };
    let turn = draw.turn();
    let sphere = Sphere { center: turn.apply(Vec3::new(0.0, -radius, 0.0)), radius };
    on_sphere(sphere, rays, || {
        let (r, lateral) = (f64::from(radius), draw.log(1e-2, 1e3));
        let (z, x) = draw.range(0.0, std::f64::consts::TAU).sin_cos();
        let drop = lateral * lateral / (r + (r * r - lateral * lateral).sqrt());
        let origin = DVec3::new(lateral * x, draw.around(nominal, 0.3) - drop, lateral * z);
        over_ground(draw, sphere, turn.apply(origin.as_vec3()))
    })
}

/// 6: the Earth in metres, the eye 1.7 above it, seen from its centre and from a map 1e5 wide.
pub(super) fn earth(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let radius = 6.371e6_f32;
    let center = [Vec3::ZERO, Vec3::new(0.0, -radius, 0.0)][variant];
    let sphere = Sphere { center, radius };
    on_sphere(sphere, rays, || {
        let height = f64::from(radius) + draw.around(1.7, 0.2);
        let up = if variant == 0 {
            draw.unit()
        } else {
            let (sin, cos) = (draw.around(1e5, 0.3) / height).sin_cos();
            let (z, x) = draw.range(0.0, std::f64::consts::TAU).sin_cos();
            DVec3::new(sin * x, cos, sin * z)
        };
        let origin = (center.as_dvec3() + up * height).as_vec3();
        over_ground(draw, sphere, origin)
    })
}

/// 7: origins exactly on the surface, so that one root is exactly 0.
pub(super) fn on_surface(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (quaternion, unit) = (draw.quaternion(), draw.power(-60, 60));
    // The points by name, and any that a frame gives, also about a centre of whole numbers.
    let (norm, named) = match variant {
        0 => (5.0, Some(DVec3::new(3.0, 4.0, 0.0))),
        1 => (65.0, Some(DVec3::new(16.0, 63.0, 0.0))),
        _ => (draw.frame(quaternion).norm, None),
    };
    let center = if variant < 3 { DVec3::ZERO } else { draw.wholes(-1000, 1000) };
    let sphere = Sphere { center: (center * unit).as_vec3(), radius: round(norm * unit) };
    on_sphere(sphere, rays, || {
        let frame = draw.frame(quaternion);
        let turn = draw.turn();
        let point = named.map_or(frame.x, |p| turn.apply(p.as_vec3()).as_dvec3());
        let direction = match draw.below(5) {
            0 => -point * draw.power(-3, 3),
            1 => point * draw.power(-3, 3),
            // Tangent: exactly so where the frame gives the point, else as near as f32 has it.
            2 if named.is_none() => frame.y * draw.power(-3, 3),
            2 => draw.across(point.normalize()),
            // To another point of the surface: the far root is exactly 1.
            3 if named.is_none() => (frame.y - point) * unit,
            _ => draw.unit() * draw.length(),
        };
        let ray = along(((center + point) * unit).as_vec3(), direction);
        if draw.chance(0.75) { ray } else { within(ray, f32::MIN_POSITIVE, f32::INFINITY) }
    })
}

/// 8: origins at r (1 +- 2^-k), k in 10..=23, looking in, out and along the surface.
pub(super) fn near_surface(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let radius = if variant == 0 { 1.0 } else { round(draw.log(1e-3, 1e3)) };
    let r = f64::from(radius);
    let center = if variant < 2 { DVec3::ZERO } else { draw.unit() * r * draw.log(0.1, 10.0) };
    let sphere = Sphere { center: center.as_vec3(), radius };
    on_sphere(sphere, rays, || {
        let away = r * (1.0 + draw.sign() * draw.power(-23, -10));
        let up = if variant == 0 { draw.turn().apply(Vec3::X).as_dvec3() } else { draw.unit() };
        let origin = (sphere.center.as_dvec3() + up * away).as_vec3();
        let along_it = draw.across(up);
        let direction = match draw.below(4) {
            0 => (draw.unit() * 0.5 - up).normalize(),
            1 => (draw.unit() * 0.5 + up).normalize(),
            2 => along_it,
            _ => (along_it - up * draw.sign() * draw.log(1e-6, 1e-1)).normalize(),
        };
        along(origin, direction * draw.length())
    })
}

/// 9: origins inside: exactly at the centre, within 1e-20 of it, anywhere.
pub(super) fn inside(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let radius = round(draw.log(1e-2, 1e2));
    let center = if variant == 1 { Vec3::ZERO } else { (draw.unit() * draw.log(1e-2, 1e2)).as_vec3() };
    on_sphere(Sphere { center, radius }, rays, || {
        let away = match variant {
            0 => 0.0,
            1 => draw.log(1e-30, 1e-10),
            _ => f64::from(radius) * draw.range(0.0, 0.99),
        };
        let origin = (center.as_dvec3() + draw.unit() * away).as_vec3();
        along(origin, draw.unit() * draw.length())
    })
}

/// 10: `d.o` exactly zero, outside (a miss) and inside (two roots of one size), with zeros of both signs.
pub(super) fn at_right_angles(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (quaternion, unit) = (draw.quaternion(), draw.power(-10, 10));
    let norm = draw.frame(quaternion).norm;
    let center = if variant == 0 { DVec3::ZERO } else { draw.wholes(-1000, 1000) };
    let radius = round(norm * 16.0 * unit);
    let sphere = Sphere { center: (center * unit).as_vec3(), radius };
    on_sphere(sphere, rays, || {
        let ray = if variant == 0 && draw.chance(0.5) {
            let zero = draw.pick(&[0.0_f32, -0.0]);
            let (y, z) = (radius * round(draw.range(-1.3, 1.3)), radius * draw.pick(&[0.0, -0.0, 0.5]));
            let direction = Vec3::new(round(draw.length()), zero, draw.pick(&[0.0, -0.0]));
            turned(draw.turn(), Ray::new(Vec3::new(zero, y, z), direction))
        } else {
            let frame = draw.frame(quaternion);
            let o = frame.y * draw.whole(-24, 24) + frame.z * draw.whole(-24, 24);
            along(((center + o) * unit).as_vec3(), frame.x * draw.power(-4, 4))
        };
        if draw.chance(0.5) { ray } else { within(ray, f32::NEG_INFINITY, f32::INFINITY) }
    })
}
