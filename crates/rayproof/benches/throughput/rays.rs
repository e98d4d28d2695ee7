//! About a million rays of each kind.

use glam::Vec3;
use rayproof::rays::{Diffuse, Incoherent, Primary};
use rayproof::scene::{Camera, Ray, Scene};

pub(crate) const KINDS: [&str; 3] = ["primary", "incoherent", "diffuse"];

const SIDE: u32 = 1024;
const COUNT: u64 = 1 << 20;
const SEED: u64 = 1;

/// A camera that frames the scene; in a hall, one that stands in its middle and looks along it.
fn camera(scene: &Scene, name: &str) -> Camera {
    let framing = Camera::framing(scene);
    let [low, high] = scene.bounds().unwrap_or_default();
    match name {
        "hall" => Camera {
            eye: (low + high) * 0.5,
            target: Vec3::new(high.x, (low.y + high.y) * 0.5, low.z),
            up: Vec3::Z,
            fov_y: 70.0,
        },
        _ => framing,
    }
}

pub(crate) fn make(scene: &Scene, name: &str, kind: &str) -> anyhow::Result<Vec<Ray>> {
    let camera = camera(scene, name);
    let primary = Primary { camera: &camera, width: SIDE, height: SIDE };
    let mut rays = Vec::new();
    match kind {
        "primary" => rays.extend(primary.blocks(1 << 20).flatten()),
        "incoherent" => rays.extend(Incoherent::new(scene, SEED).rays(0..COUNT)),
        _ => Diffuse::new(scene, primary, |_| ())?.send(COUNT, SEED, |block| {
            rays.extend_from_slice(block);
            anyhow::Ok(())
        })?,
    }
    anyhow::ensure!(!rays.is_empty(), "the camera sees nothing");
    Ok(rays)
}
