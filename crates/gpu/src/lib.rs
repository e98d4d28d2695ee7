//! How a Vulkan device answers: WGSL through naga to SPIR-V with exact `f32` rules, run by wgpu.
//!
//! [`adapters`] lists what there is, [`Gpu::open`] opens one and measures its arithmetic ([`Fingerprint`]), and
//! [`Engine`] puts a scene's tree on it and answers batches of rays.
//!
//! wgpu lets a driver rewrite `f32` arithmetic. So kernels go around its compiler: naga writes SPIR-V, every float
//! operation in it is decorated `NoContraction` and the float-control modes that the device has are asked for, and the
//! module is passed through. Where passthrough is missing plain WGSL runs, and the fingerprint tells what that did.
//!
#![doc = include_str!("../README.md")]

mod adapter;
mod batch;
mod engine;
mod error;
mod fingerprint;
mod float_controls;
mod gpu;
mod kernel;
mod kinds;
mod link;
mod pages;
mod ray_query;
mod second_stage;
mod spirv;

pub use adapter::{AdapterReport, adapters};
pub use engine::{Engine, Open};
pub use error::Error;
pub use fingerprint::{Fingerprint, Route};
pub use gpu::{Gpu, Handles, Selector};
pub use kernel::{Kernel, Pass, Query, Walk, Width};
pub use link::Linked;
pub use ray_query::RayQuery;
pub use second_stage::SecondStage;
