//! Rays that suit a scene, to look with and to measure with; the same on every machine and however they are cut into blocks.
//!
//! [`Primary`] rays go through the pixels of a picture, [`Incoherent`] ones across the scene, [`Diffuse`] ones on from where primary
//! rays hit.
//!
//! ```
//! use glam::Vec3;
//! use rayproof::rays::{Diffuse, Incoherent, Primary};
//! use rayproof::scene::{Camera, Geometry, Ray, Scene, Sphere};
//!
//! let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]).expect("made of finite numbers");
//! let primary = Primary { camera: &Camera::framing(&scene), width: 32, height: 32 };
//! let rays: Vec<Ray> = primary.blocks(256).flatten().collect();
//! assert_eq!(rays.len(), 32 * 32);
//! assert_eq!(Incoherent::new(&scene, 1).rays(0..100)[40..], Incoherent::new(&scene, 1).rays(40..100));
//!
//! let diffuse = Diffuse::new(&scene, primary, |_| ())?;
//! let mut rays = Vec::new();
//! diffuse.send(1000, 1, |block| {
//!     rays.extend_from_slice(block);
//!     Ok::<(), rayproof::Error>(())
//! })?;
//! assert_eq!(rays.len(), 1000);
//! # Ok::<(), rayproof::Error>(())
//! ```

mod bounce;
mod diffuse;
mod incoherent;
mod primary;

use glam::{DVec3, Vec3};

pub use diffuse::Diffuse;
pub use incoherent::Incoherent;
pub use primary::Primary;

/// Rounded to the nearest `f32`, within its range.
fn finite(p: DVec3) -> Vec3 {
    p.as_vec3().clamp(Vec3::MIN, Vec3::MAX)
}
