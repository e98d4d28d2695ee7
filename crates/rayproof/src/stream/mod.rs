//! Files of rays in, files of answers out: read, traced and written side by side in bounded memory, whatever their size.
//!
//! A [`Job`] runs a [`RayReader`](crate::files::RayReader) through an [`Intersector`](crate::Intersector) into a
//! [`HitWriter`](crate::files::HitWriter). The caller may cancel it, hears how far it is,
//! and keeps its own type of error. [`Shard`] opens a share of a table; [`check`] asks a judge about the [`Sample`]s that a job
//! kept.
//!
//! ```
//! use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
//!
//! use glam::Vec3;
//! use rayproof::files::{HitKind, HitWriter, InvalidRays, KeptColumns, RayWriter};
//! use rayproof::scene::{Geometry, Hit, Ray, Scene, Sphere};
//! use rayproof::stream::{Job, Shard};
//! use rayproof::{DeviceChoice, Intersector, Options};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
//! # let folder = tempfile::tempdir()?;
//! let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])]).expect("a valid scene");
//! let engine = Intersector::new(&scene, &Options { device: DeviceChoice::Cpu, ..Options::default() })?;
//!
//! // A file of rays, such as numpy.save writes from an array of shape (N, 6).
//! let rays = folder.path().join("rays.npy");
//! let mut writer = RayWriter::create(&rays, None, false, None)?;
//! writer.write(&[Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z), Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::X)])?;
//! writer.finish()?;
//!
//! let reader = Shard::WHOLE.open(&rays, InvalidRays::Error)?;
//! let (path, kept) = (folder.path().join("hits.npy"), KeptColumns::default());
//! let hits = HitWriter::create(&path, None, HitKind::Closest, reader.total(), &kept)?;
//! let (stop, traced) = (AtomicBool::new(false), AtomicUsize::new(0));
//! let job = Job { engine: &engine, samples: 1 };
//! let go_on = || if stop.load(Relaxed) { Err("cancelled".into()) } else { Ok(()) };
//! let done = job.run::<Hit, Box<dyn std::error::Error + Send + Sync>>(reader, hits, go_on, |rays| {
//!     traced.fetch_add(rays, Relaxed);
//! })?;
//! assert_eq!((done.rays, done.hits, traced.into_inner()), (2, 1, 2));
//! assert_eq!(done.samples[0].answer.t, 2.0);
//! # Ok(())
//! # }
//! ```

mod answer;
mod check;
mod job;
mod pipeline;
mod sample;
mod shard;

pub use answer::Answer;
pub use check::{Checked, Judgement, check};
pub use job::{Done, Job};
pub use sample::Sample;
pub use shard::{NotAShard, Shard, ShardError};
