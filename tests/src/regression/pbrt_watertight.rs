//! pbrt-v4, `Triangle.Watertight`: do rays get out of a closed sphere of random radii, at its vertices and at random? None does. The
//! test is disabled there, as it "fails for reasons unknown".

use glam::Vec3;
use rayproof::scene::{Geometry, Ray, Scene};
use rayproof_oracle::families::meshes;

use super::{both, recorded};
use crate::exact::rays;
use crate::scenes::Numbers;

#[test]
fn no_ray_gets_out() {
    for answers in recorded(6, 242) {
        assert!(answers.hits.iter().all(|hit| hit.is_hit()) && answers.counts.iter().all(|count| count % 2 == 1));
    }
    let mut numbers = Numbers::new(12_111);
    let mesh = meshes::bumpy_sphere(16, 16, 12_111);
    let mut point = || Vec3::new(numbers.next(), numbers.next(), numbers.next()) - 0.5;
    let rays: Vec<Ray> = (0..rays(20_000, 1_000_000))
        .map(|i| {
            let origin = point() * 0.5;
            let vertex = mesh.vertices[i % mesh.vertices.len()];
            Ray::new(origin, if i % 2 == 0 { vertex - origin } else { point() })
        })
        .collect();
    for answers in both(&Scene::new(vec![Geometry::Mesh(mesh.clone())]).expect("made of finite numbers"), &rays) {
        assert!(answers.hits.iter().all(|hit| hit.is_hit()) && answers.counts.iter().all(|count| count % 2 == 1));
    }
    println!("{} rays, 0 out", rays.len());
}
