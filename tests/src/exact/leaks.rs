//! Rays from inside closed meshes at their vertices and edges: none gets out, and each crosses an odd number of times.

use glam::{DVec3, Vec3};
use rayproof::scene::{Geometry, Mesh, Ray, Scene};
use rayproof_oracle::families::meshes;

use super::{Engines, rays};
use crate::scenes::Numbers;

/// Closed meshes, and a point well inside each.
fn closed_meshes() -> [(&'static str, Mesh, DVec3); 6] {
    [
        ("icosphere", meshes::icosphere(4), DVec3::ZERO),
        ("uv sphere", meshes::uv_sphere(48, 24), DVec3::ZERO),
        ("bumpy sphere", meshes::bumpy_sphere(16, 16, 5), DVec3::ZERO),
        ("cube of whole numbers", meshes::snapped(meshes::cube(8), 0.25), DVec3::ZERO),
        ("torus", meshes::torus(64, 32, 0.4), DVec3::X),
        ("double fan", meshes::double_fan(24), DVec3::ZERO),
    ]
}

/// From near `inside`, at vertices and at points of edges; the closest `f32` to them.
fn aimed(mesh: &Mesh, inside: DVec3, size: f64, count: usize, numbers: &mut Numbers) -> Vec<Ray> {
    let mut rays = Vec::with_capacity(count);
    for i in 0..count {
        let [a, b, c] =
            mesh.triangles[numbers.below(mesh.triangles.len())].map(|v| mesh.vertices[v as usize].as_dvec3());
        let share = numbers.below(1 << 16) as f64 / 65536.0;
        let target = if i % 2 == 0 { a } else { [a, b, c][i % 3].lerp([b, c, a][i % 3], share) };
        // A quarter start at the very middle: with whole numbers, exactly at the vertex.
        let moved = DVec3::from([(); 3].map(|()| numbers.below(1 << 16) as f64 / 65536.0 - 0.5)) * 0.1 * size;
        let origin = (inside + if i % 4 == 0 { DVec3::ZERO } else { moved }).as_vec3();
        let direction = (target - origin.as_dvec3()).as_vec3();
        if direction != Vec3::ZERO {
            rays.push(Ray::new(origin, direction));
        }
    }
    rays
}

#[test]
fn no_ray_leaks_and_every_parity_is_odd() {
    let mut numbers = Numbers::new(9);
    let (mut asked, mut open) = (0, 0);
    for (name, mesh, inside) in closed_meshes() {
        assert_eq!(meshes::open_edges(&mesh), 0, "{name} is closed");
        for size in [1e-6, 1.0, 1e6] {
            for offset in [0.0, 1e3, 1e5] {
                let at = DVec3::new(1.0, -0.7, 0.4) * offset * size;
                let placed = meshes::placed(mesh.clone(), size, at);
                // 54 places of 200,000 each are 10.8 million.
                let rays = aimed(&placed, inside * size + at, size, rays(4_000, 200_000), &mut numbers);
                let engines = Engines::new(&Scene::new(vec![Geometry::Mesh(placed)]).expect("a valid scene"));
                for (engine, answers) in [("cpu", Some(engines.on_cpu(&rays))), ("device", engines.on_device(&rays))] {
                    let answers = answers.expect("the scene is plain");
                    for (i, ray) in rays.iter().enumerate() {
                        let (hit, count) = (answers.hits[i].is_hit() && answers.any[i] == 1, answers.counts[i]);
                        assert!(
                            hit && count % 2 == 1,
                            "{engine}, {name} x {size:e} at {offset:e}: hit {hit}, {count} crossings of {ray:?}"
                        );
                    }
                    open += answers.undecided.after_refine;
                }
                asked += rays.len();
            }
        }
    }
    println!(
        "{asked} rays at vertices and edges from inside, on both engines: 0 leaks, 0 even; {open} resolved exactly"
    );
}
