//! Families 16 to 19: differences that f32 cannot hold, and roots that meet each other or the ends of the range.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Ray, Sphere};

use super::Case;
use super::aim::{along, on, on_sphere, round, turned, ulps, within};
use super::draw::Draw;

/// 16: small spheres, radius 1e-3 to 1e-1, at coordinates of 1e5 to 1e7, where an ulp is larger than they are.
pub(super) fn offset(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e5, 1e6, 1e7][variant];
    let middle = draw.unit() * draw.around(nominal, 0.2);
    let spheres: Vec<Sphere> = (0..16)
        .map(|_| Sphere { center: (middle + draw.unit() * 50.0).as_vec3(), radius: round(draw.log(1e-3, 1e-1)) })
        .collect();
    on(vec![Geometry::Spheres(spheres.clone())], rays, || {
        let sphere = draw.pick(&spheres);
        let origin = (middle + draw.unit() * draw.log(60.0, 1e4)).as_vec3();
        let to = sphere.center.as_dvec3() - origin.as_dvec3();
        let beside = draw.across(to.normalize()) * f64::from(sphere.radius) * draw.range(0.0, 1.2);
        let to = to + beside;
        // As it comes from a difference of positions, and of unit length.
        along(origin, if draw.chance(0.5) { to } else { to.normalize() * draw.length() })
    })
}

/// 17: `e - c` is not an f32: the lost bits decide between hit and miss.
pub(super) fn inexact_difference(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let center = [0; 3].map(|_| draw.sign() * draw.power(-40, -26) * draw.range(1.0, 2.0));
    let radius = if variant == 0 { 1.0 + f32::EPSILON } else { round(draw.range(1.0, 2.0)) };
    on_sphere(Sphere { center: DVec3::from_array(center).as_vec3(), radius }, rays, || {
        // Along x, off the x axis by the radius exactly: the tiny centre says which side of the limb.
        let (high, low) = (radius * round(draw.sign()), draw.pick(&[0.0, -0.0, 1e-30, f32::EPSILON]));
        let [y, z] = draw.pick(&[[high, low], [low, high]]);
        let x = round(draw.sign() * draw.log(1.0, 100.0));
        let direction = Vec3::new(-x.signum() * round(draw.length()), 0.0, 0.0);
        let ray = Ray::new(Vec3::new(x, y, z), direction);
        let shift = draw.pick(&[0, 1, 2]);
        let axes = [[0, 1, 2], [2, 0, 1], [1, 2, 0]][shift];
        let move_axes = |v: Vec3| Vec3::from_array(axes.map(|i| v.to_array()[i]));
        Ray { origin: move_axes(ray.origin), direction: move_axes(ray.direction), ..ray }
    })
}

/// 18: both roots within an ulp of each other; a root exactly at `t_min`, at `t_max`, one ulp off; `t_min` = -0.
pub(super) fn roots_at_the_ends(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    if variant == 0 {
        let radius = round(draw.log(1e-9, 1e-7));
        return on_sphere(Sphere { center: Vec3::ZERO, radius }, rays, || {
            let step = draw.wholes(-30, 30);
            let step = if step == DVec3::ZERO { DVec3::Z } else { step };
            let m = draw.whole(2, 10_000);
            let ray = along((-step * m).as_vec3(), step);
            let (m, t_max) = (round(m), f32::INFINITY);
            draw.pick(&[ray, ray, within(ray, m, t_max), within(ray, 0.0, m), within(ray, m, m)])
        });
    }
    let (quaternion, unit) = (draw.quaternion(), draw.power(-10, 10));
    let (norm, half) = (draw.frame(quaternion).norm, draw.whole(1, 64));
    on_sphere(Sphere { center: Vec3::ZERO, radius: round(norm * half * unit) }, rays, || {
        // e = -m x and d = x 2^j on a sphere of radius half |x|: the roots are (m -+ half) 2^-j, exactly.
        let (frame, scale) = (draw.frame(quaternion), draw.power(-6, 6));
        let m = if variant == 1 { draw.whole(0, 65_536) } else { draw.sign() * half };
        let ray = along((-frame.x * m * unit).as_vec3(), frame.x * unit * scale);
        let (near, far) = (round((m - half) / scale), round((m + half) / scale));
        let zero = draw.pick(&[0.0, -0.0]);
        let (up, down, inf) = (f32::next_up, f32::next_down, f32::INFINITY);
        let (t_min, t_max) = draw.pick(&[
            (zero, near),
            (zero, down(near)),
            (near, inf),
            (up(near), inf),
            (far, inf),
            (up(far), inf),
            (near, near),
            (far, far),
            (up(near), down(far)),
            (-inf, near),
            (-inf, down(near)),
            (zero, zero),
        ]);
        // A root below zero leaves no range up from zero: then the range ends there.
        if t_min <= t_max { within(ray, t_min, t_max) } else { within(ray, t_max, t_min) }
    })
}

/// 19: the surface an ulp behind the origin or ahead of it, and tangents that touch behind it.
pub(super) fn behind(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let unit = round(draw.power(-20, 20));
    on_sphere(Sphere { center: Vec3::ZERO, radius: unit }, rays, || {
        let length = round(draw.power(-4, 4));
        let (origin, t_min) = if variant == 0 {
            // Outward along the axis through the centre: the far root is 0, or a few ulps to either side of it.
            let off = draw.pick(&[-3, -2, -1, 0, 1, 2, 3]);
            (Vec3::new(ulps(unit, off), 0.0, 0.0), 0.0)
        } else {
            let m = round(draw.power(0, 30));
            let touch = -m * unit / length;
            let t_min = draw.pick(&[0.0, -0.0, touch, touch.next_up(), touch.next_down(), f32::NEG_INFINITY]);
            (Vec3::new(m * unit, unit, 0.0), t_min)
        };
        let ray = turned(draw.turn(), Ray::new(origin, Vec3::X * length));
        within(ray, t_min, f32::INFINITY)
    })
}
