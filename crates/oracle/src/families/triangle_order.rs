//! Families 35 and 36: which of two is nearer, and does the order of the vertices matter.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Ray, Sphere, Triangle};

use super::Case;
use super::aim::{along, at_mesh, on, on_mesh, round, soup, turned, turned_triangle, ulps};
use super::draw::Draw;

/// 35: layers whose t differ by 0, 1 or 2 ulps, duplicates in one geometry and in two, a sphere that ties.
pub(super) fn layers(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let turn = draw.turn();
    let depth = round(if variant == 0 { draw.power(0, 10) } else { draw.log(1.0, 1e4) });
    let layer = |z: f32| {
        let size = depth;
        let [a, b, c] = [[-size, -size], [2.0 * size, -size], [-size, 2.0 * size]].map(|[x, y]| Vec3::new(x, y, z));
        turned_triangle(turn, Triangle { a, b, c })
    };
    // The nearest is somewhere in the middle of the list, and often there twice.
    let offs: Vec<i32> = (0..6).map(|_| draw.pick(&[0, 0, 1, 2, 3])).collect();
    let mut sheets = offs.iter().map(|&off| layer(ulps(depth, off)));
    let first: Vec<Triangle> = sheets.by_ref().take(3).collect();
    let second: Vec<Triangle> = sheets.collect();
    // Touching the plane z = depth from behind, at x = y = 0; a power of two keeps its centre exact.
    let radius = depth;
    let center = turn.apply(Vec3::new(0.0, 0.0, 2.0 * depth));
    let ball = Geometry::Spheres(vec![Sphere { center, radius }, Sphere { center, radius }]);
    let (first, second) = (Geometry::Mesh(soup(&first)), Geometry::Mesh(soup(&second)));
    let geometries = if draw.chance(0.5) { vec![ball, first, second] } else { vec![first, ball, second] };
    on(geometries, rays, || {
        let length = draw.power(-3, 3);
        let sideways = if draw.chance(0.3) { DVec3::ZERO } else { draw.unit() * 0.2 };
        let origin = if draw.chance(0.3) { DVec3::ZERO } else { draw.unit() * f64::from(depth) * 0.1 };
        let straight = draw.chance(0.5);
        let (origin, sideways) = if straight { (DVec3::ZERO, DVec3::ZERO) } else { (origin, sideways) };
        let direction = (DVec3::Z + sideways) * length;
        turned(turn, along(origin.as_vec3(), direction))
    })
}

/// 36: one triangle in its six vertex orders, one scene each, met by the same rays.
pub(super) fn permuted(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let size = draw.around(1.0, 1.0);
    let corners = [0; 3].map(|_| (draw.unit() * size).as_vec3());
    let order = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]][variant];
    let [a, b, c] = corners;
    let aim = soup(&[Triangle { a, b, c }]);
    let [a, b, c] = order.map(|i: usize| corners[i]);
    on_mesh(soup(&[Triangle { a, b, c }]), rays, || {
        let away = size * draw.log(1.0, 100.0);
        let (origin, length) = ((draw.unit() * away).as_vec3(), draw.length());
        let ray = at_mesh(draw, &aim, origin, size, length);
        if draw.chance(0.5) {
            return ray;
        }
        // Exactly at a vertex, from near enough for the difference to be exact.
        loop {
            let vertex = draw.pick(&corners);
            let origin = vertex + (draw.unit() * size * 0.5).as_vec3();
            let direction = vertex - origin;
            if direction.as_dvec3() == vertex.as_dvec3() - origin.as_dvec3() && direction != Vec3::ZERO {
                return Ray::new(origin, direction);
            }
        }
    })
}
