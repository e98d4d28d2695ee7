//! About a million rays of each kind.

use glam::Vec3;
use rayproof::scene::{Camera, Hit, Primitive, Ray, Scene};
use rayproof::{DeviceChoice, Intersector, Options};

pub(crate) const KINDS: [&str; 3] = ["primary", "incoherent", "diffuse"];

const SIDE: u32 = 1024;

/// Numbers in 0..1 from a 64-bit congruence.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / 16_777_216.0
    }

    fn on_sphere(&mut self) -> Vec3 {
        let (z, phi) = (2.0 * self.next() - 1.0, std::f32::consts::TAU * self.next());
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z)
    }
}

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
    let primary: Vec<Ray> = camera(scene, name).rays(SIDE, SIDE, 0..SIDE).collect();
    let mut numbers = Numbers(1);
    Ok(match kind {
        "primary" => primary,
        "incoherent" => {
            let [low, high] = scene.bounds().unwrap_or_default();
            let (center, radius) = ((low + high) * 0.5, (high - low).length() * 0.5);
            (0..1 << 20)
                .map(|_| {
                    let from = center + numbers.on_sphere() * radius;
                    let to = low + (high - low) * Vec3::new(numbers.next(), numbers.next(), numbers.next());
                    Ray::new(from, (to - from).normalize())
                })
                .collect()
        }
        _ => diffuse(scene, &primary, &mut numbers)?,
    })
}

/// Cosine-weighted from what the primary rays hit, again and again until there are 2^20.
fn diffuse(scene: &Scene, primary: &[Ray], numbers: &mut Numbers) -> anyhow::Result<Vec<Ray>> {
    let options = Options { device: DeviceChoice::Cpu, ..Options::default() };
    let mut hits = vec![Hit::MISS; primary.len()];
    Intersector::new(scene, &options)?.closest(primary, &mut hits)?;
    let seen: Vec<(&Ray, &Hit)> = primary.iter().zip(&hits).filter(|(_, hit)| hit.is_hit()).collect();
    anyhow::ensure!(!seen.is_empty(), "the camera sees nothing");
    let mut rays = Vec::with_capacity(1 << 20);
    for (ray, hit) in seen.iter().cycle().take(1 << 20) {
        let at = ray.at(hit.t);
        let normal = match scene.primitive(hit.primitive as usize) {
            Primitive::Triangle(triangle) => triangle.normal().normalize(),
            Primitive::Sphere(sphere) => (at - sphere.center).normalize(),
        };
        let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        let off = 1e-4 * at.abs().max_element().max(hit.t);
        rays.push(Ray::new(at + normal * off, (normal + numbers.on_sphere() * 0.999).normalize()));
    }
    Ok(rays)
}
