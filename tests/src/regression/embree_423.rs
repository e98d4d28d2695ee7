//! Embree, issue 423: rays along the edges of one triangle, over 0 <= t <= 1, hit another that is far from them. They miss. After the
//! report's words: the numbers are not at hand but for the first corner's, (0x3e6a2c13, 0x3fad24ce, ..).

use glam::Vec3;
use rayproof::scene::{Geometry, Mesh, Ray, Scene};

use super::{all_miss, both};
use crate::scenes::Numbers;

#[test]
fn distant_triangles_do_not_collide() {
    let mut numbers = Numbers::new(423);
    let corner = Vec3::new(f32::from_bits(0x3e6a_2c13), f32::from_bits(0x3fad_24ce), 0.5);
    for _ in 0..200 {
        let mut near = |p: Vec3| p + (Vec3::new(numbers.next(), numbers.next(), numbers.next()) - 0.5) * 0.05;
        let vertices = vec![corner, near(corner), near(corner)];
        let far = corner + Vec3::new(0.0, 0.0, 0.5);
        let other = [near(far), near(far), near(far)];
        let rays = [0, 1, 2].map(|i| Ray { t_max: 1.0, ..Ray::new(other[i], other[(i + 1) % 3] - other[i]) });
        let mesh = Mesh { vertices, triangles: vec![[0, 1, 2]] };
        assert!(
            both(&Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers"), &rays).iter().all(all_miss)
        );
    }
}
