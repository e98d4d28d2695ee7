//! Ordinary scenes, of any size.

use glam::Vec3;
use rayproof::scene::random::Random;
use rayproof::scene::{Geometry, Mesh, Primitive, Ray, Scene, Sphere};

/// Random numbers as these tests draw them.
pub(crate) struct Numbers(Random);

impl Numbers {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(Random::new(seed, 0))
    }

    /// From 0 to 1, 1 excluded, in steps of 2^-24.
    pub(crate) fn next(&mut self) -> f32 {
        (self.0.bits() >> 40) as f32 / 16_777_216.0
    }

    /// A whole number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.0.below(n as u64)).expect("below a usize")
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// Triangles in two meshes and spheres between them, in a box of side 10; the first sphere is a ground of radius 1e4.
pub(crate) fn mixed(triangles: usize, spheres: usize) -> Scene {
    let mut n = Numbers::new(5);
    let mut meshes = [Mesh::default(), Mesh::default()];
    for i in 0..triangles {
        let mesh = &mut meshes[i % 2];
        let at = n.point() * 10.0;
        let base = u32::try_from(mesh.vertices.len()).expect("few");
        mesh.vertices.extend([at, at + n.point() - 0.5, at + n.point() - 0.5]);
        mesh.triangles.push([base, base + 1, base + 2]);
    }
    let mut balls: Vec<Sphere> =
        (0..spheres).map(|_| Sphere { center: n.point() * 10.0, radius: 0.02 + 0.2 * n.next() }).collect();
    if let (Some(ball), true) = (balls.first_mut(), spheres > 10) {
        *ball = Sphere { center: Vec3::new(5.0, -1e4, 5.0), radius: 1e4 };
    }
    let [first, second] = meshes;
    Scene::new(vec![Geometry::Mesh(first), Geometry::Spheres(balls), Geometry::Mesh(second)]).expect("a valid scene")
}

/// Rays from in and around the scene at its primitives and past them, with ranges of every kind.
pub(crate) fn rays_at(scene: &Scene, count: usize) -> Vec<Ray> {
    let mut n = Numbers::new(17);
    (0..count)
        .map(|i| {
            let from = n.point() * 30.0 - 10.0;
            let to = match (scene.len(), i % 4) {
                (0, _) | (_, 0) => n.point() * 10.0,
                (primitives, _) => match scene.primitive(i % primitives) {
                    Primitive::Triangle(t) => t.point(0.4 * n.next(), 0.4 * n.next()),
                    Primitive::Sphere(s) => s.center + s.radius.min(1.0) * (n.point() - 0.5),
                },
            };
            let mut ray = Ray::new(from, (to - from) * [1.0, 1e-3, 1e4][i % 3]);
            match i % 7 {
                0 => ray.t_max = 1.5 / [1.0, 1e-3, 1e4][i % 3],
                1 => ray.t_min = f32::NEG_INFINITY,
                2 => (ray.t_min, ray.t_max) = (-2.0, 0.25),
                _ => {}
            }
            ray
        })
        .collect()
}
