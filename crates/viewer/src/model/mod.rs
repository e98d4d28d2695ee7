//! What the viewer shows, without a window: scenes, cameras, pictures in the making, and what is asked about single rays.

pub(crate) mod gallery;
pub(crate) mod inspection;
mod job;
pub(crate) mod judge;
pub(crate) mod layer;
pub(crate) mod look;
pub(crate) mod measure;
pub(crate) mod navigate;
pub(crate) mod paint;
mod publish;
pub(crate) mod task;
pub(crate) mod tracer;
pub(crate) mod view;
pub(crate) mod world;
