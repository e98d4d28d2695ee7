//! pbrt-v4, `Triangle.Reintersect` and `FullSphere.Reintersect`: does a ray that leaves a surface, from a point moved off it as pbrt
//! moves it, meet it again? Never, if the surface is flat over that move: a sphere is larger than it. Coordinates are from 1e-8 to
//! 1e8, radii from 1e-4 to 1e4.

use glam::DVec3;
use rayproof::scene::{Geometry, Mesh, Ray, Scene, Sphere};
use rayproof_oracle::Oracle;

use super::both;
use crate::exact::rays;
use crate::scenes::Numbers;

/// A number of either sign and any magnitude from `10^low` to `10^high`.
fn log_uniform(numbers: &mut Numbers, low: f64, high: f64) -> f64 {
    let sign = if numbers.next() < 0.5 { -1.0 } else { 1.0 };
    sign * 10.0_f64.powf(low + (high - low) * f64::from(numbers.next()))
}

fn log_uniform_point(numbers: &mut Numbers, low: f64, high: f64) -> DVec3 {
    DVec3::new(log_uniform(numbers, low, high), log_uniform(numbers, low, high), log_uniform(numbers, low, high))
}

/// A hit's place, and what rounding may have cost it.
fn place(from: &Ray, t: f32) -> (DVec3, DVec3) {
    let along = from.direction.as_dvec3() * f64::from(t);
    let point = from.origin.as_dvec3() + along;
    (point, (along.abs() + point.abs() + from.origin.as_dvec3().abs()) * 2.0_f64.powi(-22))
}

/// Rays that leave a hit on the side of `normal`: from the point moved by what rounding may have cost it, as pbrt moves it.
fn spawned(from: &Ray, t: f32, normal: DVec3, count: usize, numbers: &mut Numbers) -> Vec<Ray> {
    let (point, off) = place(from, t);
    let moved = point + normal * normal.abs().dot(off);
    let origin = moved.as_vec3();
    (0..count)
        .map(|_| {
            let w = DVec3::from([(); 3].map(|()| f64::from(numbers.next()) - 0.5));
            Ray::new(origin, (if w.dot(normal) < 0.0 { -w } else { w }).as_vec3())
        })
        .filter(|ray| ray.direction.as_dvec3().dot(normal) > 0.0)
        .collect()
}

#[test]
fn a_ray_that_leaves_a_surface_does_not_meet_it_again() {
    let mut numbers = Numbers::new(77);
    let [mut shapes, mut tried] = [0, 0];
    let (wanted, each) = (rays(40, 1000), rays(100, 1000));
    while shapes < wanted {
        let is_sphere = shapes % 2 == 1;
        let center = log_uniform_point(&mut numbers, -8.0, if is_sphere { 4.0 } else { 8.0 });
        let (geometry, target) = if is_sphere {
            let radius = DVec3::splat(log_uniform(&mut numbers, -4.0, 4.0).abs()).as_vec3().x;
            (Geometry::Spheres(vec![Sphere { center: center.as_vec3(), radius }]), center)
        } else {
            let corners = [(); 3].map(|()| log_uniform_point(&mut numbers, -8.0, 8.0).as_vec3());
            let mesh = Mesh { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] };
            (Geometry::Mesh(mesh), corners.iter().map(|c| c.as_dvec3()).sum::<DVec3>() / 3.0)
        };
        let scene = Scene::new(vec![geometry]).expect("made of finite numbers");
        let origin = log_uniform_point(&mut numbers, -8.0, 8.0).as_vec3();
        let ray = Ray::new(origin, (target - origin.as_dvec3()).as_vec3());
        let hit = both(&scene, &[ray])[0].hits[0];
        if !hit.is_hit() || hit.t == 0.0 {
            continue;
        }
        let (at, off) = place(&ray, hit.t);
        let normal = match &scene.geometries()[0] {
            // The place may be anywhere about it, and so may what would be its normal there.
            Geometry::Spheres(spheres) if off.length() >= f64::from(spheres[0].radius) => continue,
            Geometry::Spheres(spheres) => (at - spheres[0].center.as_dvec3()).normalize(),
            Geometry::Mesh(mesh) => {
                let [a, b, c] = [0, 1, 2].map(|i| mesh.vertices[i].as_dvec3());
                let normal = (b - a).cross(c - a).normalize();
                if normal.dot(ray.direction.as_dvec3()) > 0.0 { -normal } else { normal }
            }
        };
        let leaving = spawned(&ray, hit.t, normal, each, &mut numbers);
        for answers in both(&scene, &leaving) {
            let oracle = Oracle::new(&scene);
            for (ray, hit) in leaving.iter().zip(&answers.hits) {
                assert!(!hit.is_hit(), "{ray:?} meets its own surface at {hit:?}; exactly {:?}", oracle.closest(ray));
            }
        }
        shapes += 1;
        tried += leaving.len();
    }
    println!("{tried} rays off {shapes} triangles and spheres, 0 meet them again");
}
