//! What there is: rays, spheres, triangles, scenes, cameras and hits.
//!
//! A [`Scene`] is a list of geometries, each a mesh or a table of spheres. A [`Ray`] asks where it first meets one
//! of them, and a [`Hit`] answers. Everything is `f32`, taken as exact: "the exact answer" means real arithmetic on
//! the stored numbers.
//!
//! ```
//! use glam::Vec3;
//! use rayproof_scene::{Ray, Sphere, Triangle};
//!
//! // A sphere is the implicit surface f(p) = (p - c).(p - c) - r^2 = 0 ...
//! let sphere = Sphere { center: Vec3::ZERO, radius: 5.0 };
//! assert_eq!(sphere.f(Vec3::new(3.0, 4.0, 0.0)), 0.0);
//!
//! // ... a triangle lies on the parametric plane f(u, v) = a + u (b - a) + v (c - a) ...
//! let triangle = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y };
//! assert_eq!(triangle.point(0.25, 0.5), Vec3::new(0.25, 0.5, 0.0));
//!
//! // ... and a ray is p(t) = e + t d.
//! let ray = Ray::new(Vec3::new(0.25, 0.5, 2.0), -Vec3::Z);
//! assert_eq!(ray.at(2.0), triangle.point(0.25, 0.5));
//! ```
//!
#![doc = include_str!("../README.md")]

pub use glam;

mod camera;
mod hit;
mod kind;
pub mod normal;
pub mod number;
mod precision;
pub mod random;
mod ray;
mod scene;
mod sphere;
mod triangle;

pub use camera::{Camera, Pixels};
pub use hit::{FlatHit, Hit, MISS, Undecided};
pub use kind::{Kind, Kinds};
pub use precision::{NotAPrecision, Precision};
pub use ray::{INVALID_RAY, InvalidRays, Ray, RayFault};
pub use scene::{Geometry, InvalidScene, Mesh, Numbering, Primitive, PrimitiveFault, Scene};
pub use sphere::Sphere;
pub use triangle::Triangle;
