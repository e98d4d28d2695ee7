//! Families 38 and 39: rays in the planes, along the edges and through the corners of bounding boxes.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Mesh, Ray, Sphere};

use super::Case;
use super::aim::{along, at_mesh, on, on_mesh};
use super::draw::Draw;
use super::meshes::{cube, grid, icosphere, placed};

/// Every triangle of these meshes, in one.
fn joined(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh::default();
    for mesh in meshes {
        let start = u32::try_from(all.vertices.len()).expect("meshes of families are small");
        all.vertices.extend(&mesh.vertices);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|i| i + start)));
    }
    all
}

/// 38: origins exactly on slab planes with zero components in the direction; flat boxes; boxes at 1e30.
pub(super) fn slab_planes(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let flat = |z: f64| placed(grid(6), 1.0, DVec3::new(-3.0, -3.0, z));
    let (mesh, size) = match variant {
        0 => (cube(4), 1.0),
        1 => (flat(0.0), 3.0),
        2 => (joined(&[flat(-1.0), flat(0.0), flat(0.5), placed(cube(1), 0.5, DVec3::splat(4.0))]), 3.0),
        _ => {
            let offset = DVec3::splat(1e30) * draw.pick(&[0.0, 1.0]);
            (placed(cube(2), draw.power(95, 100), offset), 1e30)
        }
    };
    let turn = draw.turn();
    let vertices = mesh.vertices.iter().map(|v| turn.apply(*v)).collect();
    let mesh = Mesh { vertices, ..mesh };
    on_mesh(mesh.clone(), rays, || {
        let on_plane = draw.pick(&mesh.vertices);
        let mut direction = (draw.unit() * draw.length()).as_vec3();
        // The other coordinates: those of the vertex too, or of a point in or around the mesh.
        let mut origin = (on_plane.as_dvec3() + draw.unit() * size * draw.log(0.1, 3.0)).as_vec3();
        let axis = draw.below(3);
        let two = draw.chance(0.5);
        for i in if two { vec![axis, (axis + 1) % 3] } else { vec![axis] } {
            direction[i] = draw.pick(&[0.0, -0.0]);
            origin[i] = on_plane[i];
        }
        // Toward the mesh along the last axis: the ray runs in the face of a box, or along its edge.
        let free = (axis + 2) % 3;
        direction[free] = direction[free].abs() * if origin[free] > on_plane[free] { -1.0 } else { 1.0 };
        if direction == Vec3::ZERO {
            direction[free] = 1.0;
        }
        Ray::new(origin, direction)
    })
}

/// 39: along box edges, through box corners; nodes flat on an axis, and nodes 2^24 times the size of a child.
pub(super) fn box_edges(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    if variant == 2 {
        return mixed_sizes(draw, rays);
    }
    let flat = |z: f64| placed(grid(4), 1.0, DVec3::new(-2.0, -2.0, z));
    let mesh = if variant == 0 { cube(3) } else { joined(&[flat(0.0), flat(1.0)]) };
    let (size, turn) = (draw.power(-8, 8), draw.turn());
    // Thirds are not exact: snapped to 1/1024 the sums below are.
    let vertices = mesh.vertices.iter().map(|v| turn.apply((v.as_dvec3() * 1024.0).round().as_vec3() / 1024.0));
    let mesh = placed(Mesh { vertices: vertices.collect(), ..mesh }, size, DVec3::ZERO);
    on_mesh(mesh.clone(), rays, || {
        let corner = draw.pick(&mesh.vertices).as_dvec3();
        let direction = loop {
            let d = draw.wholes(-1, 1);
            if d != DVec3::ZERO {
                break d;
            }
        };
        let from = corner - direction * size * draw.whole(-2, 40) / 8.0;
        along(from.as_vec3(), direction * draw.power(-4, 4))
    })
}

/// Tiny meshes and spheres beside large ones: their common box is more than 2^24 times theirs.
fn mixed_sizes(draw: &mut Draw, rays: usize) -> Case {
    let tiny: Vec<Mesh> = (0..4)
        .map(|_| placed(icosphere(0), draw.log(1e-9, 1e-6), (draw.unit() * draw.log(1e-7, 10.0)).as_vec3().as_dvec3()))
        .collect();
    let far = placed(cube(1), draw.around(1e3, 0.3), draw.wholes(-100, 100));
    let spheres = (0..4).map(|_| Sphere { center: (draw.unit() * 5.0).as_vec3(), radius: 1e-7 }).collect();
    let all = joined(&[tiny.clone(), vec![far.clone()]].concat());
    on(vec![Geometry::Mesh(all), Geometry::Spheres(spheres)], rays, || {
        let mesh = if draw.chance(0.8) { &tiny[draw.below(tiny.len())] } else { &far };
        let near = mesh.vertices[0].as_dvec3();
        let origin = (near + draw.unit() * draw.log(1e-6, 1e2)).as_vec3();
        at_mesh(draw, mesh, origin, 1e-6, 1.0)
    })
}
