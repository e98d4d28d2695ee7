//! How the CPU answers: a twin of every kernel in `shaders/`, on all cores.
//!
//! A twin has its kernel's path and names and does the same operations in the same order, so that its answers equal the
//! device's in every bit wherever the device's arithmetic is IEEE. The derivations stand in the WGSL headers.
//!
//! [`Engine`] holds a scene's tree; [`Engine::closest`], [`Engine::any`] and [`Engine::count`] answer batches of rays.
//!
//! ```
//! use glam::Vec3;
//! use rayproof_cpu::Engine;
//! use rayproof_scene::{Geometry, Hit, Precision, Ray, Scene, Sphere};
//! use rayproof_tree::{Bvh, Scaling};
//!
//! let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]);
//! let engine = Engine::new(Bvh::new(&scene, Scaling::of(Precision::Fast))?, Precision::Fast);
//! let mut hits = [Hit::MISS];
//! engine.closest(&[Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z)], &mut hits);
//! assert_eq!(hits[0].t, 2.0);
//! # Ok::<(), rayproof_tree::TooLarge>(())
//! ```
#![allow(clippy::suboptimal_flops, reason = "mul_add would round differently from the kernels")]

mod batch;
mod bvh;
mod classic;
mod double;
mod engine;
mod exact;
mod fast;
mod formulas;
mod lanes;
mod leaf;
mod math;
mod number;
mod primitives;
mod simd;
mod textbook;

pub use engine::Engine;

/// How many threads the engine uses.
#[must_use]
pub fn threads() -> usize {
    rayon::current_num_threads()
}
