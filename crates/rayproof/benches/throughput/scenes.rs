//! The scenes, from files or made.

use std::path::Path;

use glam::Vec3;
use rayproof::files::load;
use rayproof::scene::random::Random;
use rayproof::scene::{Geometry, Mesh, Scene, Sphere};

/// Name and rows of a mesh of four times their square in triangles, for where the file is not there.
const SCENES: [(&str, u32); 3] = [("bunny", 131), ("dragon", 466), ("hall", 270)];

pub(crate) fn all() -> anyhow::Result<Vec<(&'static str, Scene)>> {
    let folder = std::env::var("RAYPROOF_SCENES").unwrap_or_default();
    let meshes = SCENES.into_iter().map(|(name, rows)| {
        let file = Path::new(&folder).join(format!("{name}.ply"));
        let scene = if file.exists() { load(&file)?.scene } else { made(rows) };
        Ok((name, scene))
    });
    meshes.chain([Ok(("spheres", spheres()))]).collect()
}

/// A million spheres at random places of a cube, at random sizes about a third of their mean distance.
fn spheres() -> Scene {
    let mut random = Random::new(3, 0);
    let mut sphere = |_| {
        let center = random.in_cube().as_vec3() * 100.0;
        Sphere { center, radius: 0.1 + 0.4 * random.single() }
    };
    Scene::new(vec![Geometry::Spheres((0..1_000_000).map(&mut sphere).collect())]).expect("made of finite numbers")
}

/// A closed ball with bumps of several sizes.
fn made(rows: u32) -> Scene {
    let columns = rows * 2;
    let mut mesh = Mesh::default();
    for i in 0..=rows {
        for j in 0..columns {
            let (theta, phi) =
                (std::f32::consts::PI * i as f32 / rows as f32, std::f32::consts::TAU * j as f32 / columns as f32);
            let r =
                1.0 + 0.1 * (5.0 * theta).sin() * (7.0 * phi).cos() + 0.01 * (61.0 * theta).sin() * (83.0 * phi).cos();
            mesh.vertices.push(Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()) * r);
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            let (a, b) = (i * columns + j, i * columns + (j + 1) % columns);
            mesh.triangles.extend([[a, a + columns, b], [b, a + columns, b + columns]]);
        }
    }
    Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers")
}
