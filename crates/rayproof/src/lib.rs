//! Ray hits you can trust: pick a device, stream batches of rays through it, get the hits back.
//!
//! [`Intersector::new`] takes a [`Scene`](scene::Scene) and [`Options`], builds the tree and puts it on the device;
//! [`Intersector::closest`], [`Intersector::any`] and [`Intersector::count`] answer batches of any size, by default in the
//! [`Precision`] `Exact`: the answers of real arithmetic on the given numbers, `t`, `u` and `v` rounded once. `adapters` lists
//! what there is. [`stream`] answers files of rays that memory need not hold, [`rays`] makes rays.
//!
//! ```
//! use rayproof::scene::{Geometry, Hit, Mesh, Ray, Scene, Sphere};
//! use rayproof::{DeviceChoice, Intersector, Options};
//!
//! let mesh = Mesh::new([[-1.0, -1.0, 5.0], [1.0, -1.0, 5.0], [0.0, 1.0, 5.0]], vec![[0, 1, 2]]);
//! let sphere = Sphere::new([0.0, 0.0, 0.0], 1.0);
//! let scene = Scene::new(vec![Geometry::Mesh(mesh), Geometry::Spheres(vec![sphere])])?;
//!
//! let options = Options { device: DeviceChoice::Cpu, ..Options::default() };
//! let intersector = Intersector::new(&scene, &options)?;
//! let from = [0.0, 0.0, -3.0];
//! let mut hits = [Hit::MISS; 2];
//! intersector.closest(&[Ray::new(from, [0.0, 0.0, 1.0]), Ray::new(from, [1.0, 0.0, 0.0])], &mut hits)?;
//! assert_eq!((hits[0].t, hits[0].geometry, hits[0].primitive), (2.0, 1, 0));
//! assert!(!hits[1].is_hit());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What a hit is: the smallest `t` with `t_min <= t <= t_max`, both ends included; triangles are closed and two-sided;
//! both roots of a sphere count; among equal `t` the lowest number wins.
//!
#![doc = include_str!("../README.md")]

mod admit;
mod batch;
mod choice;
mod device;
mod error;
#[cfg(feature = "gpu")]
mod gpu;
mod intersector;
#[cfg(feature = "measure")]
pub mod measure;
#[cfg(not(feature = "gpu"))]
mod no_gpu;
pub mod rays;
#[cfg(feature = "files")]
pub mod stream;

#[cfg(not(feature = "gpu"))]
use no_gpu as gpu;

pub use batch::BATCH;
pub use choice::{DeviceChoice, DeviceInfo, Options};
pub use device::Device;
pub use error::Error;
pub use gpu::Error as DeviceError;
pub use intersector::Intersector;
#[cfg(feature = "files")]
pub use rayproof_files as files;
#[cfg(feature = "gpu")]
pub use rayproof_gpu::{AdapterReport, Fingerprint, Handles, adapters};
pub use rayproof_scene as scene;
pub use rayproof_scene::Precision;
pub use rayproof_scene::glam;
pub use rayproof_tree::TooLarge;
