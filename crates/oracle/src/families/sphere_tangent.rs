//! Families 1 to 4 and 20: spheres whose verdict hangs on a discriminant that cancels.

use glam::{DVec3, Vec3};
use rayproof_scene::Sphere;

use super::Case;
use super::aim::{along, on_sphere, passing, passing_exactly, round, turned, within};
use super::draw::{Draw, one_of};

/// 1: radius 1 at distance 10^1 to 10^7, any impact parameter.
pub(super) fn far(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7][variant];
    let center = if draw.chance(0.5) { Vec3::ZERO } else { (draw.unit() * draw.log(0.1, 10.0)).as_vec3() };
    on_sphere(Sphere { center, radius: 1.0 }, rays, || {
        let (distance, length) = (draw.around(nominal, 0.5), draw.length());
        let impact = draw.range(0.0, 1.1);
        passing(draw, center, distance, impact, length)
    })
}

/// 2: distance 1e6, impact parameter 1 +- k 2^-24 for k in 1..=1000.
pub(super) fn near_tangent(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    on_sphere(Sphere { center: Vec3::ZERO, radius: 1.0 }, rays, || {
        let off = draw.log(1.0, 1000.0).round() * (-24_f64).exp2();
        let impact = round(1.0 + draw.sign() * off);
        let slant = if variant == 0 { 0.0 } else { draw.range(-0.9, 0.5) };
        let distance = draw.around(1e6, 0.3);
        passing_exactly(draw, distance, impact, slant)
    })
}

/// 3: distance 10, impact parameter 1 - 10^-k and 1 + 10^-k for k in 1..=7.
pub(super) fn limb(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7][variant];
    on_sphere(Sphere { center: Vec3::ZERO, radius: 1.0 }, rays, || {
        let impact = 1.0 + draw.sign() * draw.around(nominal, 0.4);
        let distance = draw.around(10.0, 0.3);
        if draw.chance(0.5) {
            let slant = draw.pick(&[0.0, 0.4, -0.7]);
            passing_exactly(draw, distance, round(impact), slant)
        } else {
            let length = draw.length();
            passing(draw, Vec3::ZERO, distance, impact, length)
        }
    })
}

/// 4: tangent rays whose discriminant is exactly zero.
pub(super) fn exact_tangent(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    if variant == 0 {
        // e = (-2^k, 1, 0), d = (1, 0, 0), all times powers of two: the touching point is at t = 2^k.
        let unit = draw.pick(&[1.0, 1.0, 0.0625, 65536.0]);
        return on_sphere(Sphere { center: Vec3::ZERO, radius: round(unit) }, rays, || {
            let origin = DVec3::new(-draw.power(0, 40) * unit, unit, 0.0);
            let direction = DVec3::X * if draw.chance(0.5) { 1.0 } else { draw.power(-8, 8) };
            turned(draw.turn(), along(origin.as_vec3(), direction))
        });
    }
    let (quaternion, unit) = (draw.quaternion(), draw.power(-20, 20));
    let norm = draw.frame(quaternion).norm;
    let offset = if variant == 1 { DVec3::ZERO } else { draw.wholes(-5000, 5000) };
    let sphere = Sphere { center: (offset * unit).as_vec3(), radius: round(norm * unit) };
    on_sphere(sphere, rays, || {
        let frame = draw.frame(quaternion);
        let origin = offset + frame.y * draw.sign() - frame.x * draw.whole(0, 65_536);
        along((origin * unit).as_vec3(), frame.x * draw.power(-4, 4))
    })
}

/// 20: directions almost at right angles to the way to the centre, so that `d.o` is rounding noise.
pub(super) fn perpendicular(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (center, radius) = [(Vec3::ZERO, 1.0), ((draw.unit() * 3.0).as_vec3(), draw.log(1e-2, 1e2))][variant];
    let sphere = Sphere { center, radius: round(radius) };
    on_sphere(sphere, rays, || {
        // Inside, outside, and at the surface, where the tangent touches the sphere at t = 0.
        let away = radius * one_of([draw.log(0.01, 0.99), draw.log(1.01, 10.0), 1.0], draw);
        let origin = (center.as_dvec3() + draw.unit() * away).as_vec3();
        let o = (origin.as_dvec3() - center.as_dvec3()).normalize_or(DVec3::X);
        let ray = along(origin, draw.across(o) * draw.length());
        if draw.chance(0.5) { ray } else { within(ray, f32::NEG_INFINITY, f32::INFINITY) }
    })
}
