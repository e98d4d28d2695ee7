use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::time::{Duration, Instant};

use rayproof_scene::{FlatHit, Hit, InvalidRays, Numbering, Ray, Scene, Undecided};
use rayproof_tree::{Bvh, Scaling};

use crate::admit::admit;
use crate::gpu::{Open, describe, suited};
use crate::{Device, DeviceInfo, Error, Options, Precision};

/// A scene made ready on a device.
pub struct Intersector {
    pub(crate) engine: Engine,
    info: DeviceInfo,
    build_seconds: f64,
    precision: Precision,
    numbering: Numbering,
    invalid_rays: InvalidRays,
    resolve_nanoseconds: AtomicU64,
    /// Bad rays so far.
    invalid: AtomicU64,
}

pub(crate) enum Engine {
    Cpu(Box<rayproof_cpu::Engine>),
    /// The CPU's own walk, for the precision `exact`.
    Exact(Box<rayproof_cpu::Exact>),
    /// With the engine that gives the precision `exact` its last answers.
    Gpu(Box<crate::gpu::Engine>, Option<Box<rayproof_cpu::Engine>>),
}

impl Engine {
    /// The engine that suits scene and precision, on the device if it does; and how many seconds its tree took.
    fn on(device: &Device, scene: &Scene, precision: Precision) -> Result<(Self, DeviceInfo, f64), Error> {
        let start = Instant::now();
        let note = if device.is_cpu() {
            device.note.clone()
        } else {
            let bvh = Bvh::new(scene, Scaling::of(precision))?;
            let build_seconds = start.elapsed().as_secs_f64();
            match suited(device, &bvh, precision)? {
                Ok(gpu) => {
                    let info = describe(gpu, precision);
                    let engine = Box::new(crate::gpu::Engine::new(gpu.clone(), &bvh, precision)?);
                    let last =
                        (precision == Precision::Exact).then(|| rayproof_cpu::Engine::new(bvh, precision).into());
                    return Ok((Self::Gpu(engine, last), info, build_seconds));
                }
                Err(note) => note,
            }
        };
        let engine = match precision {
            Precision::Exact => Self::Exact(rayproof_cpu::Exact::new(scene)?.into()),
            _ => Self::Cpu(rayproof_cpu::Engine::new(Bvh::new(scene, Scaling::of(precision))?, precision).into()),
        };
        Ok((engine, cpu_info(note), start.elapsed().as_secs_f64()))
    }
}

impl Intersector {
    /// Builds the tree and puts the scene on the device.
    ///
    /// # Errors
    /// When the device is not there, cannot hold the scene, or fails.
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, Error> {
        // The device first: a wrong name should not cost the building of a tree.
        let made = Self::on(&Device::open(&options.device)?, scene, options.precision)?;
        Ok(Self { invalid_rays: options.invalid_rays, ..made })
    }

    /// As [`new`](Self::new), on a device that is open: for many scenes one after the other. Bad rays are refused.
    ///
    /// # Errors
    /// When the device cannot hold the scene, or fails.
    pub fn on(device: &Device, scene: &Scene, precision: Precision) -> Result<Self, Error> {
        let (engine, info, build_seconds) = Engine::on(device, scene, precision)?;
        Ok(Self {
            engine,
            info,
            build_seconds,
            precision,
            numbering: scene.numbering().clone(),
            invalid_rays: InvalidRays::Error,
            resolve_nanoseconds: AtomicU64::new(0),
            invalid: AtomicU64::new(0),
        })
    }

    /// This scene in another precision, on the CPU engine; the two share one tree. `None` where that takes a tree of its
    /// own: on a device, where one precision scales the scene and the other does not, and for `exact`.
    #[must_use]
    pub fn with_precision(&self, precision: Precision) -> Option<Self> {
        let Engine::Cpu(engine) = &self.engine else { return None };
        if precision == Precision::Exact {
            return None;
        }
        let engine = Engine::Cpu(Box::new(engine.with_precision(precision)?));
        Some(Self {
            engine,
            info: self.info.clone(),
            build_seconds: 0.0,
            precision,
            numbering: self.numbering.clone(),
            invalid_rays: self.invalid_rays,
            resolve_nanoseconds: AtomicU64::new(0),
            invalid: AtomicU64::new(0),
        })
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

    /// The closest hit of each ray, any number of them, in the rays' order; returned is how many rays the precision `exact` left
    /// open on its way.
    ///
    /// # Errors
    /// When the device fails, or [`Error::InvalidRay`].
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) -> Result<Undecided, Error> {
        self.closest_as(rays, hits, Hit::MISS, |hit| self.numbering.hit(hit))
    }

    /// As [`closest`](Self::closest), by flat numbers: for judges and pictures, which share them with the engines.
    ///
    /// # Errors
    /// When the device fails, or [`Error::InvalidRay`].
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest_flat(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Undecided, Error> {
        self.closest_as(rays, hits, FlatHit::MISS, |hit| hit)
    }

    fn closest_as<A: Copy + Send>(
        &self,
        rays: &[Ray],
        hits: &mut [A],
        miss: A,
        make: impl Fn(FlatHit) -> A + Sync,
    ) -> Result<Undecided, Error> {
        self.answer(
            rays,
            hits,
            miss,
            |engine, rays, hits| engine.closest_as(rays, hits, &make),
            |engine, rays, hits| engine.closest_as(rays, hits, &make),
            |engine, rays, hits| engine.closest_as(rays, hits, &make),
        )
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Errors
    /// When the device fails, or [`Error::InvalidRay`].
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Result<Undecided, Error> {
        self.answer(rays, hits, 0, rayproof_cpu::Exact::any, rayproof_cpu::Engine::any, crate::gpu::Engine::any)
    }

    /// How often each ray crosses the surface: through a shared edge or vertex of a closed mesh once, at a tangent of a sphere
    /// twice. Only the precision `exact` counts.
    ///
    /// # Errors
    /// When the device fails, [`Error::InvalidRay`] or [`Error::NotExact`].
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Result<Undecided, Error> {
        self.check_exact()?;
        let (exact, on_cpu) = (rayproof_cpu::Exact::count, rayproof_cpu::Engine::count);
        self.answer(rays, counts, 0, exact, on_cpu, crate::gpu::Engine::count)
    }

    /// Asks the engine, and the CPU for what a device leaves open.
    fn answer<A: Copy>(
        &self,
        rays: &[Ray],
        answers: &mut [A],
        miss: A,
        exact: impl Fn(&rayproof_cpu::Exact, &[Ray], &mut [A]) -> Undecided,
        on_cpu: impl Fn(&rayproof_cpu::Engine, &[Ray], &mut [A]) -> Undecided,
        on_device: impl Fn(&crate::gpu::Engine, &[Ray], &mut [A]) -> Result<Open, crate::gpu::Error>,
    ) -> Result<Undecided, Error> {
        let rays = &*self.admit(rays)?;
        match &self.engine {
            Engine::Exact(engine) => Ok(exact(engine, rays, answers)),
            Engine::Cpu(engine) => Ok(on_cpu(engine, rays, answers)),
            Engine::Gpu(engine, last) => {
                let open = on_device(engine, rays, answers)?;
                Ok(self.resolve(last.as_deref(), &open, rays, answers, miss, on_cpu))
            }
        }
    }

    /// The rays as an engine may have them; bad ones are refused or counted.
    fn admit<'r>(&self, rays: &'r [Ray]) -> Result<Cow<'r, [Ray]>, Error> {
        let (rays, invalid) = admit(rays, self.invalid_rays)?;
        self.invalid.fetch_add(invalid, Relaxed);
        Ok(rays)
    }

    /// How many bad rays became misses so far.
    #[must_use]
    pub fn invalid_rays(&self) -> u64 {
        self.invalid.load(Relaxed)
    }

    /// Which stage of the cascade decides the closest hit of each ray: 1 in `f32`, 2 in double width, 3 exact arithmetic.
    ///
    /// # Errors
    /// When the device fails, or [`Error::NotExact`].
    ///
    /// # Panics
    /// When `rays` and `stages` differ in length.
    pub fn deciding_stages(&self, rays: &[Ray], stages: &mut [u8]) -> Result<(), Error> {
        self.check_exact()?;
        let rays = &*self.admit(rays)?;
        match &self.engine {
            Engine::Exact(engine) => engine.deciding_stages(rays, stages),
            Engine::Cpu(engine) => engine.deciding_stages(rays, stages),
            Engine::Gpu(engine, _) => {
                stages.fill(1);
                for i in engine.open_after_first(rays)?.rays {
                    stages[i] = 2;
                }
                for i in engine.closest_as(rays, &mut vec![(); rays.len()], |_| ())?.rays {
                    stages[i] = 3;
                }
            }
        }
        Ok(())
    }

    /// Seconds so far for which a device waited for exact arithmetic on the CPU; the CPU engine's own are part of its tracing.
    #[must_use]
    pub fn resolve_seconds(&self) -> f64 {
        Duration::from_nanos(self.resolve_nanoseconds.load(Relaxed)).as_secs_f64()
    }

    fn check_exact(&self) -> Result<(), Error> {
        if self.precision == Precision::Exact { Ok(()) } else { Err(Error::NotExact) }
    }

    /// Gives the rays that a device left open their answers, on the CPU.
    fn resolve<A: Copy>(
        &self,
        last: Option<&rayproof_cpu::Engine>,
        open: &Open,
        rays: &[Ray],
        answers: &mut [A],
        miss: A,
        ask: impl Fn(&rayproof_cpu::Engine, &[Ray], &mut [A]) -> Undecided,
    ) -> Undecided {
        let Some(last) = last else { return Undecided::default() };
        let start = Instant::now();
        let left: Vec<Ray> = open.rays.iter().map(|&i| rays[i]).collect();
        let mut found = vec![miss; left.len()];
        ask(last, &left, &mut found);
        for (&i, found) in open.rays.iter().zip(found) {
            answers[i] = found;
        }
        let nanoseconds = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.resolve_nanoseconds.fetch_add(nanoseconds, Relaxed);
        let left = left.len() as u64;
        Undecided { first_stage: open.after_first, after_refine: left, resolved_on_cpu: left }
    }
}

pub(crate) fn cpu_info(note: Option<String>) -> DeviceInfo {
    let threads = rayproof_cpu::threads();
    DeviceInfo {
        name: format!("CPU engine, {threads} thread{}", if threads == 1 { "" } else { "s" }),
        driver: format!("rayproof-cpu {}", env!("CARGO_PKG_VERSION")),
        notes: note.into_iter().collect(),
    }
}
