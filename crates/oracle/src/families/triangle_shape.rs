//! Families 24 to 28: slivers, grazing rays, offsets, sizes and lengths of direction.

use glam::{DVec3, Vec3};
use rayproof_scene::{Ray, Triangle};

use super::Case;
use super::aim::{along, at_mesh, on_mesh, round, soup, toward, turned, turned_triangle, ulps};
use super::draw::{Draw, one_of};
use super::meshes::{bumpy_sphere, cube, double_fan, icosphere, placed};

/// 24: needles and caps of aspect 1e-3 to 1e-7, and triangles without area.
pub(super) fn slivers(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e-3, 1e-5, 1e-7, 1e-3, 1e-5, 1e-7, 0.0, 0.0, 0.0][variant];
    let long = draw.unit();
    let short = draw.across(long) * if nominal > 0.0 { draw.around(nominal, 0.5) } else { 0.0 };
    // At zero the short end keeps all its bits; elsewhere it is a few ulps wide, or none.
    let at = if draw.chance(0.5) { DVec3::ZERO } else { draw.unit() };
    let corners = match variant {
        0..3 => [at, at + short, at + long],
        3..6 => [at, at + short - long * draw.range(0.2, 0.8), at + long * draw.range(0.2, 0.8)],
        6 => {
            let (start, step) = (draw.wholes(-100, 100), draw.wholes(-20, 20));
            [start, start + step * draw.whole(1, 30), start - step * draw.whole(0, 30)]
        }
        7 => [at, at + long, at],
        _ => [at; 3],
    };
    let [a, b, c] = corners.map(|p| p.as_vec3());
    let [a, b, c] = draw.pick(&[[a, b, c], [b, c, a], [c, a, b], [c, b, a]]);
    let mesh = soup(&[Triangle { a, b, c }]);
    let size = if variant == 6 { 100.0 } else { 1.0 };
    on_mesh(mesh.clone(), rays, || {
        let (origin, length) = ((at + draw.unit() * draw.log(1.0, 20.0) * size).as_vec3(), draw.length());
        let spread = size * f64::max(2.0 * nominal, 1e-6);
        let ray = at_mesh(draw, &mesh, origin, spread, length);
        // Exactly at a vertex, where whole numbers allow it.
        let exact = draw.pick(&[a, b, c]).as_dvec3() - origin.as_dvec3().round();
        let whole = variant == 6 && draw.chance(0.5) && exact != DVec3::ZERO;
        if whole { along(origin.round(), exact) } else { ray }
    })
}

/// 25: grazing angles of 1e-1 to 1e-7, and rays in the plane: through the inside, along an edge, at a vertex alone.
pub(super) fn grazing(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    if variant >= 7 {
        return in_plane(draw, variant - 7, rays);
    }
    let nominal = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7][variant];
    let flat = |draw: &mut Draw| DVec3::new(draw.range(-1.0, 1.0), draw.range(-1.0, 1.0), 0.0).as_vec3();
    let triangle = Triangle { a: flat(draw), b: flat(draw), c: flat(draw) };
    let (mesh, turn) = (soup(&[triangle]), draw.turn());
    let placed = soup(&[turned_triangle(turn, triangle)]);
    on_mesh(placed, rays, || {
        // The third axis of the ray holds the angle alone, so it keeps all its bits.
        let target = super::aim::point_of(draw, &mesh);
        let (sin, cos) = draw.range(0.0, std::f64::consts::TAU).sin_cos();
        let direction = DVec3::new(cos, sin, draw.sign() * draw.around(nominal, 0.4)) * draw.length();
        let distance = draw.log(0.5, 20.0) / direction.length();
        turned(turn, along((target - direction * distance).as_vec3(), direction))
    })
}

/// Rays exactly in the plane of a slanted triangle of whole coordinates, or an ulp beside it.
fn in_plane(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let quaternion = draw.quaternion();
    let frame = draw.frame(quaternion);
    let at = |u: f64, v: f64| frame.x * u + frame.y * v;
    let plane = frame.z * draw.whole(-8, 8);
    // (0, 0), (8, 0), (2, 8) in the plane: the line v = 8 meets it at a vertex alone.
    let corners = [at(0.0, 0.0), at(8.0, 0.0), at(2.0, 8.0)].map(|p| p + plane);
    let [a, b, c] = corners.map(|p| p.as_vec3());
    on_mesh(soup(&[Triangle { a, b, c }]), rays, || {
        let (through, direction) = match variant {
            0 => (at(draw.whole(2, 4), draw.whole(1, 3)), at(draw.whole(-9, 9), draw.whole(1, 9))),
            1 => {
                let i = draw.below(3);
                (corners[i] - plane, corners[(i + 1) % 3] - corners[i])
            }
            _ => (at(2.0, 8.0), at(draw.pick(&[1.0, -1.0]), 0.0)),
        };
        let origin = (through + plane - direction * draw.whole(-20, 60)).as_vec3();
        let ray = along(origin, direction * draw.power(-3, 3));
        let off = draw.pick(&[0, 0, 0, 1, -1]);
        Ray { origin: Vec3::new(ulps(ray.origin.x, off), ray.origin.y, ray.origin.z), ..ray }
    })
}

/// 26: coordinates offset by 1e5 with detail down to 1e-3, by 2^24 with ulps of 2, and vertices of mixed scale.
pub(super) fn offset(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (offset, size) = match variant {
        0 => (draw.unit() * draw.around(1e5, 0.3), draw.log(1e-3, 10.0)),
        1 => (draw.turn().apply(Vec3::splat(16_777_216.0)).as_dvec3(), draw.log(4.0, 400.0)),
        _ => (DVec3::ZERO, 1.0),
    };
    let corners = match variant {
        2 => [1.0, 1e5, 1e-5].map(|size| draw.unit() * draw.around(size, 0.3)),
        _ => [0; 3].map(|_| offset + draw.unit() * size),
    };
    let [a, b, c] = corners.map(|p| p.as_vec3());
    let mesh = soup(&[Triangle { a, b, c }]);
    on_mesh(mesh.clone(), rays, || {
        let away = size * draw.log(1.0, 100.0);
        let (origin, length) = ((offset + draw.unit() * away).as_vec3(), draw.length());
        at_mesh(draw, &mesh, origin, size, length)
    })
}

/// 27: triangles of size 1e-4 down to subnormal and 1e12 up to 1e38.
pub(super) fn sizes(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e-4, 1e-10, 1e-16, 1e-30, 1e-39, 1e12, 1e18, 1e19, 1e30, 1e38][variant];
    let shape = match draw.below(4) {
        0 => icosphere(1),
        1 => cube(1),
        2 => double_fan(6),
        _ => bumpy_sphere(6, 4, draw.below(1 << 30) as u64),
    };
    // The bumpy one reaches out to 6; below 0.5 all stay finite, origins included.
    let size = nominal * draw.log(0.1, 0.5);
    let mesh = placed(shape, size, DVec3::ZERO);
    on_mesh(mesh.clone(), rays, || {
        let away = size * one_of([0.0, 0.4, draw.log(1.0, 6.5)], draw);
        let length = one_of([1.0, draw.length(), size.max(1e-44)], draw);
        let origin = (draw.unit() * away).as_vec3();
        let ray = at_mesh(draw, &mesh, origin, size, length);
        // Exactly the difference of vertex and origin, where that is what a user would pass.
        let difference = draw.pick(&mesh.vertices) - origin;
        if draw.chance(0.25) && difference.is_finite() { along(origin, difference.as_dvec3()) } else { ray }
    })
}

/// 28: directions of length 1e-20 to 1e20 at a mesh of unit size.
pub(super) fn direction_lengths(draw: &mut Draw, _variant: usize, rays: usize) -> Case {
    let mesh = icosphere(1);
    on_mesh(mesh.clone(), rays, || {
        let (origin, length) = ((draw.unit() * draw.log(0.1, 20.0)).as_vec3(), draw.log(1e-20, 1e20));
        if draw.chance(0.25) {
            let vertex = draw.pick(&mesh.vertices).as_dvec3();
            return toward(origin, vertex, f64::from(round(length)));
        }
        at_mesh(draw, &mesh, origin, 1.0, length)
    })
}
