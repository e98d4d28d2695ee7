use std::time::Instant;

use rayproof_gpu::{Gpu, Selector};
use rayproof_scene::bvh::Bvh;
use rayproof_scene::{Hit, Ray, Scene, Undecided};

use crate::{DeviceInfo, Error, Options, Precision};

/// A scene made ready on a device.
pub struct Intersector {
    engine: Engine,
    info: DeviceInfo,
    build_seconds: f64,
    precision: Precision,
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
        let gpu = gpu.filter(|_| tier != Precision::Exact); // Its kernels are still to come.
        let (engine, info) = match gpu {
            Some(gpu) => {
                let info = describe(&gpu);
                (Engine::Gpu(Box::new(rayproof_gpu::Engine::new(gpu.into(), &bvh, tier)?)), info)
            }
            None => (Engine::Cpu(Box::new(rayproof_cpu::Engine::new(bvh, tier))), cpu_info(note)),
        };
        Ok(Self { engine, info, build_seconds, precision: tier })
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

    /// The closest hit of each ray, any number of them, in the rays' order; returned is how many rays the tier `exact` left
    /// open on its way.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) -> Result<Undecided, Error> {
        match &self.engine {
            Engine::Cpu(engine) => Ok(engine.closest(rays, hits)),
            Engine::Gpu(engine) => Ok(engine.closest(rays, hits).map(|()| Undecided::default())?),
        }
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Result<Undecided, Error> {
        match &self.engine {
            Engine::Cpu(engine) => Ok(engine.any(rays, hits)),
            Engine::Gpu(engine) => Ok(engine.any(rays, hits).map(|()| Undecided::default())?),
        }
    }

    /// How often each ray crosses the surface: through a shared edge or vertex of a closed mesh once, at a tangent of a sphere
    /// twice. Only the tier `exact` counts.
    ///
    /// # Errors
    /// When the device fails, or [`Error::NotExact`].
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Result<Undecided, Error> {
        self.check_exact()?;
        match &self.engine {
            Engine::Cpu(engine) => Ok(engine.count(rays, counts)),
            Engine::Gpu(_) => unreachable!(),
        }
    }

    /// Which tier of the cascade decides the closest hit of each ray: 1 in `f32`, 2 in double width, 3 exact arithmetic.
    ///
    /// # Errors
    /// When the device fails, or [`Error::NotExact`].
    ///
    /// # Panics
    /// When `rays` and `tiers` differ in length.
    pub fn deciding_tiers(&self, rays: &[Ray], tiers: &mut [u8]) -> Result<(), Error> {
        self.check_exact()?;
        match &self.engine {
            Engine::Cpu(engine) => engine.deciding_tiers(rays, tiers),
            Engine::Gpu(_) => unreachable!(),
        }
        Ok(())
    }

    /// Seconds so far for which a device waited for exact arithmetic on the CPU; the CPU engine's own are part of its tracing.
    #[must_use]
    pub fn resolve_seconds(&self) -> f64 {
        0.0
    }

    fn check_exact(&self) -> Result<(), Error> {
        if self.precision == Precision::Exact { Ok(()) } else { Err(Error::NotExact) }
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
