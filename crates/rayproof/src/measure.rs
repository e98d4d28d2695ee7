//! What only measuring asks for; the feature `measure` has it.

pub use rayproof_gpu::Route;
use rayproof_scene::Ray;

use crate::gpu::Gpu;
use crate::intersector::Engine;
use crate::{Device, DeviceChoice, DeviceError, Error, Intersector};

impl Device {
    /// Opens a device with kernels that take a route of one's own choice, to measure what the usual one costs.
    ///
    /// # Errors
    /// [`DeviceError::Unsupported`] when it is the CPU engine or has no such route; else when it is not there, or fails.
    pub fn open_with_route(choice: &DeviceChoice, route: Route) -> Result<Self, Error> {
        let no_kernels = || DeviceError::Unsupported { what: "the CPU engine has no kernels".to_owned() };
        let gpu = Gpu::open_with_route(&choice.selector().ok_or_else(no_kernels)?, route)?;
        Ok(Self { gpu: Some(gpu.into()), note: None })
    }
}

impl Intersector {
    /// This intersector without its tree: every ray is tested with every primitive. It tells what the formulas cost by themselves.
    #[must_use]
    pub fn without_tree(mut self) -> Self {
        self.engine = match self.engine {
            Engine::Exact(engine) => Engine::Exact(Box::new(engine.without_tree())),
            Engine::Cpu(engine) => Engine::Cpu(Box::new(engine.without_tree())),
            Engine::Gpu(engine, last) => Engine::Gpu(Box::new(engine.without_tree()), last),
        };
        self
    }

    /// How many primitives claim that a ray hits them in range, by the formulas of the precision: no count of crossings, but
    /// what it takes for one. Those of `exact` are its [`count`](Self::count). Only the CPU engine tells.
    ///
    /// # Errors
    /// [`Error::OnDevice`].
    ///
    /// # Panics
    /// When `rays` and `claims` differ in length.
    pub fn claims(&self, rays: &[Ray], claims: &mut [u32]) -> Result<(), Error> {
        match &self.engine {
            Engine::Cpu(engine) => {
                engine.claims(rays, claims);
                Ok(())
            }
            Engine::Exact(engine) => {
                engine.count(rays, claims);
                Ok(())
            }
            Engine::Gpu(..) => Err(Error::OnDevice),
        }
    }

    /// Seconds that kernels have run so far, by the device's own clock; `None` where it has none, and on the CPU engine.
    #[must_use]
    pub fn kernel_seconds(&self) -> Option<f64> {
        match &self.engine {
            Engine::Cpu(_) | Engine::Exact(_) => None,
            Engine::Gpu(engine, _) => engine.kernel_seconds(),
        }
    }
}
