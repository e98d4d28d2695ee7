//! Ray hits you can trust: pick a device, stream batches of rays through it, get the hits back.
//!
//! [`Intersector::new`] takes a scene and [`Options`]; [`Intersector::closest`] and [`Intersector::any`] answer rays.

pub use rayproof_scene as scene;
use rayproof_scene::{Hit, Ray, Scene};

/// How hits are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// The two formulas by the book in `f32`: the baseline that the report measures.
    Classic,
    /// `f32`, the best-conditioned single-precision form of each.
    #[default]
    Fast,
}

/// Which device answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum DeviceChoice {
    /// A hardware GPU if there is one, else the CPU engine.
    #[default]
    Auto,
    /// The CPU engine.
    Cpu,
    /// The best Vulkan adapter, a software one too.
    Gpu,
    /// The adapter of that number in the list of `rayproof devices`.
    Index(usize),
    /// The first adapter whose name holds that text, letter case aside.
    Name(String),
    /// The adapter on that PCI bus, as `0000:01:00.0`.
    Pci(String),
}

/// What an [`Intersector`] is made for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How hits are computed.
    pub precision: Precision,
    /// Which device answers.
    pub device: DeviceChoice,
}

/// Why an intersector could not be made or could not go on.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The device asked for is not there: exit code 4. The message lists those that are.
    #[error("{0}")]
    NoDevice(String),
    /// The device failed while running: exit code 1.
    #[error("{0}")]
    Device(String),
}

/// The device an [`Intersector`] runs on.
#[derive(Clone, Debug)]
pub struct DeviceInfo {
    /// For example `llvmpipe (LLVM 15.0.6, 256 bits)`, or `CPU engine, 2 threads`.
    pub name: String,
    /// For example `llvmpipe Mesa 22.3.6 (LLVM 15.0.6)`, or `rayproof-cpu 0.1.0`.
    pub driver: String,
    /// What the user should know about it, empty where nothing: the arithmetic is not IEEE, no Vulkan was found.
    pub notes: Vec<String>,
}

/// A scene made ready on a device.
pub struct Intersector {
    info: DeviceInfo,
}

impl Intersector {
    /// Builds the BVH and puts the scene on the device.
    ///
    /// # Errors
    /// When the device is not there or cannot hold the scene.
    pub fn new(_scene: &Scene, _options: &Options) -> Result<Self, Error> {
        Err(Error::Device("not written yet".into()))
    }

    /// The device that answers.
    #[must_use]
    pub const fn device(&self) -> &DeviceInfo {
        &self.info
    }

    /// Seconds that building the BVH took.
    #[must_use]
    pub const fn build_seconds(&self) -> f64 {
        0.0
    }

    /// The closest hit of each ray, any number of them, in the rays' order.
    ///
    /// # Errors
    /// When the device is lost.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, _rays: &[Ray], _hits: &mut [Hit]) -> Result<(), Error> {
        Ok(())
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Errors
    /// When the device is lost.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, _rays: &[Ray], _hits: &mut [u8]) -> Result<(), Error> {
        Ok(())
    }
}
