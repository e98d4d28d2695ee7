use std::time::Instant;

use rayproof_gpu::{Gpu, Selector};
use rayproof_scene::bvh::Bvh;
use rayproof_scene::{Hit, Ray, Scene};

use crate::{DeviceInfo, Error, Options};

/// A scene made ready on a device.
pub struct Intersector {
    engine: Engine,
    info: DeviceInfo,
    build_seconds: f64,
}

enum Engine {
    Cpu(Box<rayproof_cpu::Engine>),
    Gpu(Box<rayproof_gpu::Engine>),
}

impl Intersector {
    /// Builds the tree and puts the scene on the device.
    ///
    /// # Errors
    /// When the device is not there, cannot hold the scene, or fails.
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, Error> {
        let tier = options.precision;
        // The device first: a wrong name should not cost the building of a tree.
        let (gpu, note) = open(options)?;
        let start = Instant::now();
        let bvh = Bvh::new(scene, tier.scaling())?;
        let build_seconds = start.elapsed().as_secs_f64();
        let (engine, info) = match gpu {
            Some(gpu) => {
                let info = describe(&gpu);
                (Engine::Gpu(Box::new(rayproof_gpu::Engine::new(gpu.into(), &bvh, tier)?)), info)
            }
            None => (Engine::Cpu(Box::new(rayproof_cpu::Engine::new(bvh, tier))), cpu_info(note)),
        };
        Ok(Self { engine, info, build_seconds })
    }

    /// The device that answers.
    #[must_use]
    pub const fn device(&self) -> &DeviceInfo {
        &self.info
    }

    /// Seconds that building the tree took.
    #[must_use]
    pub const fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    /// The closest hit of each ray, any number of them, in the rays' order.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) -> Result<(), Error> {
        match &self.engine {
            Engine::Cpu(engine) => engine.closest(rays, hits),
            Engine::Gpu(engine) => engine.closest(rays, hits)?,
        }
        Ok(())
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Result<(), Error> {
        match &self.engine {
            Engine::Cpu(engine) => engine.any(rays, hits),
            Engine::Gpu(engine) => engine.any(rays, hits)?,
        }
        Ok(())
    }
}

/// The device to run on; `None` for the CPU engine, with the reason where it is the fallback.
fn open(options: &Options) -> Result<(Option<Gpu>, Option<String>), Error> {
    let Some(selector) = options.device.selector() else { return Ok((None, None)) };
    match Gpu::open(&selector) {
        Ok(gpu) => Ok((Some(gpu), None)),
        Err(rayproof_gpu::Error::NoAdapter { .. }) if selector == Selector::Hardware => {
            Ok((None, Some("no hardware GPU with a Vulkan driver was found".to_owned())))
        }
        Err(e) if selector == Selector::Hardware => Ok((None, Some(format!("the GPU could not be used: {e}")))),
        Err(e) => Err(e.into()),
    }
}

fn cpu_info(note: Option<String>) -> DeviceInfo {
    let threads = rayproof_cpu::threads();
    DeviceInfo {
        name: format!("CPU engine, {threads} thread{}", if threads == 1 { "" } else { "s" }),
        driver: format!("rayproof-cpu {}", env!("CARGO_PKG_VERSION")),
        notes: note.into_iter().collect(),
    }
}

fn describe(gpu: &Gpu) -> DeviceInfo {
    let mut notes = Vec::new();
    if let Some(fingerprint) = gpu.fingerprint()
        && !fingerprint.is_ieee()
    {
        notes.push(format!(
            "this device's f32 arithmetic ({}) is not IEEE: its bits differ from the CPU's; see `rayproof devices`",
            fingerprint.route
        ));
    }
    DeviceInfo { name: gpu.name().to_owned(), driver: gpu.driver(), notes }
}
