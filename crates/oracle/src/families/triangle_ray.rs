//! Families 29 to 31 and 34: directions with ties and zeros, origins on the triangle, distance, the rim of u and v.

use glam::{DVec3, Vec3};
use rayproof_scene::{Ray, Triangle};

use super::Case;
use super::aim::{along, on_mesh, passing_exactly, point_of, round, soup, turned, turned_triangle, ulps, within};
use super::draw::{Draw, one_of};
use super::meshes::{bumpy_sphere, placed, snapped};

/// 29: equal largest components, one or two zeros of either sign, a component of 1e-30.
pub(super) fn axis_ties(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let mesh = placed(bumpy_sphere(8, 6, draw.below(1 << 30) as u64), 256.0, DVec3::ZERO);
    // Whole vertices are hit exactly; the others as near as rounding allows.
    let mesh = if variant == 0 { snapped(mesh, 1.0) } else { mesh };
    on_mesh(mesh.clone(), rays, || {
        let part = draw.whole(0, 8) / 8.0;
        let zero = draw.pick(&[0.0_f32, -0.0]);
        let direction = one_of(
            [
                Vec3::new(1.0, 1.0, round(part)),
                Vec3::ONE,
                Vec3::new(1.0, 1.0, zero),
                Vec3::new(1.0, zero, draw.pick(&[0.0, -0.0])),
                Vec3::new(1.0, round(part), zero),
                Vec3::new(1.0, 1.0, 1e-30),
                Vec3::new(1.0, 1e-30, -1e-30),
                Vec3::new(1.0, 1.0_f32.next_down(), zero),
            ],
            draw,
        );
        let ray = turned(draw.turn(), Ray::new(Vec3::ZERO, direction * round(draw.power(-6, 6))));
        let target = if variant == 0 { draw.pick(&mesh.vertices).as_dvec3() } else { point_of(draw, &mesh) };
        let steps = if draw.chance(0.25) { 0.0 } else { draw.whole(1, 4096) };
        let step = direction_of(ray) * steps;
        Ray { origin: (target - step).as_vec3(), ..ray }
    })
}

/// The direction scaled exactly to a largest component in 1..2.
fn direction_of(ray: Ray) -> DVec3 {
    let d = ray.direction.as_dvec3();
    d / d.abs().max_element().log2().floor().exp2()
}

/// 30: origins exactly on the triangle, on its edges and vertices, an ulp above and below, and in its plane.
pub(super) fn origin_on(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let quaternion = draw.quaternion();
    let (frame, unit) = (draw.frame(quaternion), draw.power(-10, 10));
    let at = |u: f64, v: f64| (frame.x * u + frame.y * v + frame.z * 3.0) * unit;
    let corners = [at(0.0, 0.0), at(16.0, 0.0), at(4.0, 16.0)];
    let [a, b, c] = corners.map(|p| p.as_vec3());
    on_mesh(soup(&[Triangle { a, b, c }]), rays, || {
        let point = match draw.below(5) {
            0 => draw.pick(&corners),
            1 => at(draw.whole(0, 16), 0.0),
            2 => {
                let k = draw.whole(0, 4);
                at(k, 4.0 * k)
            }
            3 => at(draw.whole(4, 8), draw.whole(1, 8)),
            // In the plane, outside.
            _ => at(draw.whole(-40, -1), draw.whole(-20, 20)),
        };
        let direction = match draw.below(4) {
            0 => frame.z * draw.sign() * draw.power(-3, 3),
            1 => at(draw.whole(-4, 4), draw.whole(-4, 4)) - at(0.0, 0.0),
            _ => draw.unit() * draw.length(),
        };
        let ray = along(point.as_vec3(), direction);
        let off = if variant == 0 { 0 } else { draw.pick(&[-1, 1]) };
        let axis = draw.below(3);
        let mut origin = ray.origin;
        origin[axis] = ulps(origin[axis], off);
        let ray = Ray { origin, ..ray };
        let tiny = f32::MIN_POSITIVE;
        draw.pick(&[ray, ray, within(ray, -0.0, 0.0), within(ray, tiny, f32::INFINITY), within(ray, -1.0, 1.0)])
    })
}

/// 31: a unit triangle from 1e4 and 1e6 away, aimed at it and past one edge by multiples of 2^-24.
pub(super) fn distant(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e4, 1e6][variant / 2];
    let mut corner = || (draw.unit() * draw.log(0.3, 1.0)).as_vec3();
    let triangle = Triangle { a: corner(), b: corner(), c: corner() };
    if variant.is_multiple_of(2) {
        let mesh = soup(&[triangle]);
        return on_mesh(mesh.clone(), rays, || {
            let target = point_of(draw, &mesh);
            let distance = draw.around(nominal, 0.3);
            let from = draw.unit() * distance;
            along((target + from).as_vec3(), -from.normalize() * draw.length())
        });
    }
    // The edge lies in a plane z = h, and so does the ray but for k 2^-24: the sign of k is the verdict.
    let height = round(draw.range(0.5, 1.0));
    let triangle = Triangle {
        a: Vec3::new(-1.0, -1.0, height),
        b: Vec3::new(1.0, 1.0, height),
        c: Vec3::new(1.0, -1.0, height - 1.0),
    };
    on_mesh(soup(&[triangle]), rays, || {
        loop {
            let distance = draw.around(nominal, 0.3);
            let off = draw.pick(&[-1000, -10, -2, -1, 0, 1, 2, 10]);
            let ray = passing_exactly(draw, distance, ulps(height, off), 0.0);
            // That turns the axes at random; keep those that leave the third in place, right way up, and cross the edge.
            let d = ray.direction;
            if d.z == 0.0 && ray.origin.z > 0.0 && (d.x - d.y).abs() > 0.01 * d.length() {
                break ray;
            }
        }
    })
}

/// 34: u + v = 1 to an ulp on either side, u and v at zero and a bit below.
pub(super) fn rim(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let turn = draw.turn();
    let triangle = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y };
    on_mesh(soup(&[turned_triangle(turn, triangle)]), rays, || {
        let bit = (-24_f64).exp2();
        let step = draw.pick(&[-2.0, -1.0, 0.0, 0.0, 1.0, 2.0]);
        let (u, v) = if draw.chance(0.5) {
            let u = (draw.range(0.0, 1.0) / bit).round() * bit;
            (u, 1.0 - u + step * bit)
        } else {
            let below = draw.pick(&[step * bit, -f64::from(f32::from_bits(1)), f64::from(f32::from_bits(1))]);
            (below, (draw.range(0.0, 1.0) / bit).round() * bit)
        };
        let [u, v] = draw.pick(&[[u, v], [v, u]]);
        // Slanted in steps of 1/8 the origin is exact where it stays below 1; else its rounding moves u and v.
        let slant = |draw: &mut Draw, at: f64| if variant == 1 && at > 0.5 { draw.whole(0, 4) / 8.0 } else { 0.0 };
        let (x, y) = (slant(draw, u), slant(draw, v));
        let scale = draw.power(-4, 4);
        let origin = DVec3::new(u - x, v - y, draw.power(0, 10));
        let direction = DVec3::new(x / origin.z, y / origin.z, -1.0) * scale;
        turned(turn, along(origin.as_vec3(), direction))
    })
}
