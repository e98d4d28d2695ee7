//! In the place of `gpu.rs` in a build without the feature `gpu`: no device is ever there, so nothing here is ever called but
//! [`Gpu::open`].

use std::sync::Arc;

use rayproof_scene::{FlatHit, Ray};
use rayproof_tree::Bvh;

use crate::{Device, DeviceInfo, Precision};

/// A device: there is none.
#[derive(Debug)]
pub(crate) enum Gpu {}

/// A scene on a device: there is none.
#[derive(Debug)]
pub(crate) enum Engine {}

/// What a batch left open.
pub(crate) struct Open {
    pub(crate) after_first: u64,
    pub(crate) rays: Vec<usize>,
}

/// Which adapter to open: none can be.
#[derive(Debug, PartialEq)]
pub(crate) enum Selector {
    Hardware,
    Best,
    Index(usize),
    Name(String),
    Pci(String),
}

/// Why there is no device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The library was built without devices.
    #[error("this build knows of no device but `cpu`: it lacks the feature `gpu`")]
    NoAdapter {},
}

impl Gpu {
    pub(crate) const fn open(_: &Selector) -> Result<Self, Error> {
        Err(Error::NoAdapter {})
    }

    pub(crate) const fn is_software(&self) -> bool {
        match *self {}
    }
}

impl Engine {
    pub(crate) fn new(gpu: Arc<Gpu>, _: &Bvh, _: Precision) -> Result<Self, Error> {
        match *gpu {}
    }

    pub(crate) fn closest_as<A>(&self, _: &[Ray], _: &mut [A], _: impl Fn(FlatHit) -> A) -> Result<Open, Error> {
        match *self {}
    }

    pub(crate) fn any(&self, _: &[Ray], _: &mut [u8]) -> Result<Open, Error> {
        match *self {}
    }

    pub(crate) fn count(&self, _: &[Ray], _: &mut [u32]) -> Result<Open, Error> {
        match *self {}
    }

    pub(crate) fn open_after_first(&self, _: &[Ray]) -> Result<Open, Error> {
        match *self {}
    }
}

/// The CPU engine answers, and a note says why where something else was sought.
pub(crate) fn suited<'d>(
    device: &'d Device,
    _: &Bvh,
    _: Precision,
) -> Result<Result<&'d Arc<Gpu>, Option<String>>, Error> {
    Ok(device.gpu.as_ref().ok_or_else(|| device.note.clone()))
}

pub(crate) fn describe(gpu: &Gpu, _: Precision) -> DeviceInfo {
    match *gpu {}
}
