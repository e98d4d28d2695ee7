//! How the CPU answers: a twin of every kernel in `shaders/`, on all cores.
//!
//! `twin/` mirrors `shaders/` path for path: a twin has its kernel's names and does the same operations in the same order, so
//! that its answers equal the device's in every bit wherever the device's arithmetic is IEEE. The derivations stand in the WGSL
//! headers. Beside it stand what kernels do not have: four triangles abreast, and the later stages of the precision `exact`.
//!
//! [`Engine`] holds a scene's tree; [`Engine::closest`], [`Engine::any`] and [`Engine::count`] answer batches of rays. For the precision
//! `exact` there is [`Exact`], with a tree of its own and the same answers, faster.
//!
//! ```
//! use glam::Vec3;
//! use rayproof_cpu::Engine;
//! use rayproof_scene::{Geometry, FlatHit, Precision, Ray, Scene, Sphere};
//! use rayproof_tree::{Bvh, Scaling};
//!
//! let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]).expect("a valid scene");
//! let engine = Engine::new(Bvh::new(&scene, Scaling::of(Precision::Fast))?, Precision::Fast);
//! let mut hits = [FlatHit::MISS];
//! engine.closest(&[Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z)], &mut hits);
//! assert_eq!(hits[0].t, 2.0);
//! # Ok::<(), rayproof_tree::TooLarge>(())
//! ```
//!
#![doc = include_str!("../README.md")]
#![allow(clippy::suboptimal_flops, reason = "mul_add would round differently from the kernels")]

mod branch;
mod eight;
mod engine;
mod exact;
mod f64x4;
mod formulas;
mod lanes;
#[cfg(feature = "measure")]
mod measure;
mod pages;
mod primitives;
mod simd;
mod twin;

pub use eight::Exact;
pub use engine::Engine;

/// How many threads the engine uses.
#[must_use]
pub fn threads() -> usize {
    rayon::current_num_threads()
}
