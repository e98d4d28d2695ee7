//! Families 21 to 23, 32 and 33: rays through what triangles share, vertices and edges.

use glam::{DVec3, Vec3};
use rayproof_scene::{Mesh, Ray, Triangle};

use super::Case;
use super::aim::{along, on_mesh, point_of, soup, toward, turned, turned_triangle};
use super::draw::Draw;
use super::meshes::{bumpy_sphere, cube, double_fan, grid, icosphere, placed, snapped, torus};

/// A closed mesh of whole coordinates around zero, multiples of 8 below 2^11.
fn whole_mesh(draw: &mut Draw) -> Mesh {
    let seed = draw.below(1 << 30) as u64;
    let (mesh, size) = match draw.below(5) {
        0 => (bumpy_sphere(12, 8, seed), 320.0),
        1 => (cube(2), 1024.0),
        2 => (torus(12, 8, 0.4), 1024.0),
        3 => (icosphere(1), 1600.0),
        _ => (double_fan(6), 1024.0),
    };
    snapped(placed(mesh, size, DVec3::ZERO), 8.0)
}

/// An origin of whole coordinates: around zero, near it, or at any distance up to 2^13.
fn whole_origin(draw: &mut Draw) -> DVec3 {
    let far = draw.pick(&[1, 40, 8191]);
    draw.wholes(-far, far)
}

/// The exact ray from one whole point to another; `d` is a power of two times their difference.
fn exact_ray(draw: &mut Draw, origin: DVec3, target: DVec3) -> Ray {
    along(origin.as_vec3(), (target - origin) * if draw.chance(0.5) { 1.0 } else { draw.power(-6, 6) })
}

/// 21: rays exactly at vertices of valence 3, 6, 15 and 1000, and of closed meshes.
pub(super) fn at_vertices(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let fan = |k| snapped(placed(double_fan(k), 2000.0, DVec3::ZERO), 1.0);
    let mesh = match variant {
        0 => fan(3),
        1 => fan(6),
        2 => fan(15),
        3 => fan(1000),
        _ => whole_mesh(draw),
    };
    on_mesh(mesh.clone(), rays, || {
        let origin = whole_origin(draw);
        // The tips of a fan are its first and last vertex; the rim is aimed at as well.
        let tips = [mesh.vertices[0], mesh.vertices[mesh.vertices.len() - 1]];
        let tip = if variant < 4 && draw.chance(0.6) { draw.pick(&tips) } else { draw.pick(&mesh.vertices) };
        exact_ray(draw, origin, tip.as_dvec3())
    })
}

/// 22: rays at points of shared edges: exact points, rounded ones, edges along an axis through the ray's own axis.
pub(super) fn at_edges(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let mesh = match variant {
        0 => whole_mesh(draw),
        1 => bumpy_sphere(12, 8, draw.below(1 << 30) as u64),
        _ => {
            let turn = draw.turn();
            let mut mesh = placed(grid(8), draw.power(-4, 4), DVec3::ZERO);
            mesh.vertices.iter_mut().for_each(|v| *v = turn.apply(*v));
            mesh
        }
    };
    on_mesh(mesh.clone(), rays, || {
        let triangle = draw.pick(&mesh.triangles).map(|i| mesh.vertices[i as usize].as_dvec3());
        let i = draw.below(3);
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        let origin = whole_origin(draw);
        match variant {
            0 => {
                let target = a + (b - a) * draw.whole(1, 7) / 8.0;
                exact_ray(draw, origin, target)
            }
            1 => {
                let target = a + (b - a) * draw.range(0.0, 1.0);
                toward((draw.unit() * 0.4).as_vec3(), target, draw.length())
            }
            _ => {
                // Both ends of the edge keep a zero of the ray's two other axes, or the ray runs along the diagonal.
                let target = a + (b - a) * draw.whole(0, 16) / 16.0;
                let normal = (b - a).cross(triangle[(i + 2) % 3] - a).normalize();
                let slant = if draw.chance(0.5) { DVec3::ZERO } else { (b - a) * draw.whole(-3, 3) };
                let d = normal * draw.sign() * draw.power(-2, 2) + slant;
                along((target - d * draw.power(0, 3)).as_vec3(), d)
            }
        }
    })
}

/// 23: whole coordinates below 2^11, so that ties are exact: at vertices, at points of edges, in planes.
pub(super) fn whole_numbers(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let most = [15, 127, 2047][variant];
    // Even differences: the middle of an edge is whole too.
    let odd = draw.wholes(0, 1);
    let corner = |draw: &mut Draw| (draw.wholes(-most / 2, most / 2) * 2.0 + odd).as_vec3();
    let triangles: Vec<Triangle> =
        (0..16).map(|_| Triangle { a: corner(draw), b: corner(draw), c: corner(draw) }).collect();
    on_mesh(soup(&triangles), rays, || {
        let t = draw.pick(&triangles);
        let [a, b, c] = draw.pick(&[[t.a, t.b, t.c], [t.b, t.c, t.a], [t.c, t.a, t.b]]).map(|p| p.as_dvec3());
        let target = match draw.below(4) {
            0 => a,
            1 => (a + b) * 0.5,
            2 => ((a + b + c) / 3.0).round(),
            _ => draw.wholes(-most, most),
        };
        let anywhere = draw.wholes(-most, most);
        let origin = draw.pick(&[anywhere, anywhere, a + b - c, target + (b - a)]);
        exact_ray(draw, origin, target)
    })
}

/// 32: neighbours with a dihedral angle of about 1e-7, and folded ones, whose shared edge is a silhouette.
pub(super) fn folds(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let bend = |draw: &mut Draw| draw.sign() * draw.log(1e-8, 1e-6);
    let (left, right) = match variant {
        0 => (DVec3::new(-1.0, 0.0, bend(draw)), DVec3::new(1.0, 0.0, bend(draw))),
        1 => (DVec3::new(1.0, 0.25, bend(draw)), DVec3::new(1.0, 0.0, bend(draw))),
        _ => (DVec3::new(0.75, 0.25, -0.25), DVec3::new(1.0, 0.0, 0.5)),
    };
    let (a, b) = (DVec3::new(0.0, -1.0, 0.0), DVec3::new(0.0, 1.0, 0.0));
    let turn = draw.turn();
    let vertices: Vec<Vec3> = [a, b, left, right].iter().map(|p| turn.apply(p.as_vec3())).collect();
    // The last is closed by two more triangles: a thin tetrahedron, met 0 or 2 times by any ray from outside.
    let mut triangles = vec![[0, 1, 2], [1, 0, 3]];
    if variant == 2 {
        triangles.extend([[0, 2, 3], [2, 1, 3]]);
    }
    on_mesh(Mesh { vertices, triangles }, rays, || {
        let target = match draw.below(4) {
            0 => draw.pick(&[a, b, left, right]),
            1 => DVec3::new(draw.range(-0.5, 0.5), draw.range(-1.0, 1.0), 0.0),
            _ => DVec3::new(0.0, draw.whole(-16, 16) / 16.0, 0.0),
        };
        let step = draw.wholes(-8, 8);
        let step = if step == DVec3::ZERO { DVec3::Z } else { step };
        turned(turn, along((target - step * draw.power(-3, 3)).as_vec3(), step))
    })
}

/// 33: T-junctions: a long edge beside two short ones whose common vertex is rounded off the long one.
pub(super) fn t_junction(draw: &mut Draw, _variant: usize, rays: usize) -> Case {
    let (a, b) = (draw.unit(), draw.unit() * draw.log(0.5, 2.0));
    let out = draw.across((b - a).normalize());
    let middle = a + (b - a) * draw.range(0.2, 0.8);
    let [a, b, middle, left, right] = [a, b, middle, middle - out, middle + out].map(|p| p.as_vec3());
    let turn = draw.turn();
    let triangles =
        [Triangle { a, b, c: left }, Triangle { a, b: right, c: middle }, Triangle { a: middle, b: right, c: b }]
            .map(|t| turned_triangle(turn, t));
    let mesh = soup(&triangles);
    let [a, b, middle] = [a, b, middle].map(|p| turn.apply(p).as_dvec3());
    on_mesh(mesh.clone(), rays, || {
        let target = match draw.below(4) {
            0 => middle,
            1 => point_of(draw, &mesh),
            _ => a + (b - a) * draw.range(0.0, 1.0),
        };
        let origin = (target + draw.unit() * draw.log(0.5, 20.0)).as_vec3();
        toward(origin, target, draw.length())
    })
}
