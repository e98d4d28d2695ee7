//! How a Vulkan device answers: WGSL through naga to SPIR-V with exact `f32` rules, run by wgpu.
//!
//! [`adapters`] lists what there is, [`Gpu::open`] opens one and measures its arithmetic ([`Fingerprint`]), and
//! [`Engine`] puts a scene's tree on it and answers batches of rays.
//!
//! wgpu lets a driver rewrite `f32` arithmetic. So kernels go around its compiler: naga writes SPIR-V, every float
//! operation in it is decorated `NoContraction` and the float-control modes that the device has are asked for, and the
//! module is passed through. Where passthrough is missing plain WGSL runs, and the fingerprint tells what that did.
//!
//! `RAYPROOF_DUMP=FOLDER` in the environment writes each kernel to that folder as it is compiled: the linked WGSL, and the SPIR-V
//! that the driver gets, named after its part, query, contents and numbers (`first-closest-triangles-f32.wgsl` and `.spv`; the
//! last of a name stays). A folder that cannot be written is an error.
//!
#![doc = include_str!("../README.md")]

mod adapter;
mod batch;
mod compute;
mod context;
mod dump;
mod engine;
mod error;
mod fingerprint;
mod float_controls;
mod gpu;
mod guard;
mod kernel;
mod kinds;
mod link;
#[cfg(feature = "measure")]
mod measure;
mod pages;
#[cfg(feature = "measure")]
mod ray_query;
mod route;
mod second_stage;
mod spirv;
mod survey;
mod trial;

pub use adapter::Selector;
pub use context::Handles;
pub use engine::{Engine, Open};
pub use error::Error;
pub use fingerprint::{Arithmetic, Fingerprint};
pub use gpu::Gpu;
pub use kernel::{Kernel, Pass, Query, Walk, Width};
pub use link::Linked;
#[cfg(feature = "measure")]
pub use ray_query::RayQuery;
pub use route::Route;
pub use second_stage::{SecondStage, Trials};
pub use survey::{AdapterReport, adapters};
pub use trial::Verdict;
