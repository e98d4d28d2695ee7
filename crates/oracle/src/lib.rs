//! What the answer *is*: brute force in exact rational arithmetic, slow and independent of every engine; and the
//! judge that compares an engine's answer with it.
//!
//! An [`Oracle`] answers one ray at a time, as the contract defines a hit, with no rounding anywhere. An answer of an
//! engine goes to [`judge_closest`](judge::judge_closest), which says whether it is the exact one, one that the
//! single-precision formulas are allowed, or wrong; two engines that must agree to the bit go to
//! [`compare_bits`](judge::compare_bits). How an answer comes about is laid out by [`work`](worked::work), exactly and by
//! the formulas of the precisions side by side.
//!
//! ```
//! use glam::Vec3;
//! use rayproof_oracle::{Oracle, judge::{Verdict, judge_closest}};
//! use rayproof_scene::{Geometry, FlatHit, Ray, Scene, Sphere};
//!
//! let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]).expect("a valid scene");
//! let oracle = Oracle::new(&scene);
//! let ray = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z);
//!
//! let hit = oracle.closest(&ray).expect("the ray meets the sphere").to_hit();
//! assert_eq!(hit, FlatHit { t: 2.0, u: 0.0, v: 0.0, primitive: 0 });
//!
//! assert!(matches!(judge_closest(&oracle, &ray, &hit), Verdict::Exact(_)));
//! assert!(matches!(judge_closest(&oracle, &ray, &FlatHit::MISS), Verdict::Disagrees(..)));
//! ```
//!
#![doc = include_str!("../README.md")]

pub mod families;
mod filter;
pub mod judge;
mod oracle;
mod rational;
mod root;
mod second;
mod sphere;
mod triangle;
pub mod worked;

#[cfg(test)]
mod tests;

pub use oracle::{ExactHit, Oracle};
pub use root::Root;
pub use second::{Agreement, SecondAnswer, SecondOracle, compare, compare_hits};
