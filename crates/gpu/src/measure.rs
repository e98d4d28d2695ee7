//! What only measuring asks for: other routes, other numbers, no tree, small bindings, the device's clock.

use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

use rayproof_scene::Precision;
use rayproof_tree::Bvh;

use crate::adapter::{Adapters, Selector};
use crate::context::Context;
use crate::engine::refused;
use crate::kernel::{Walk, Width};
use crate::{Engine, Error, Fingerprint, Gpu, Route, SecondStage};

impl Gpu {
    /// Opens an adapter with kernels that take a route of one's own choice; the precision `exact` runs on its own alone.
    ///
    /// # Errors
    /// As [`open`](Self::open), and [`Error::Unsupported`] when the device has no such route.
    pub fn open_with_route(selector: &Selector, route: Route) -> Result<Self, Error> {
        let adapters = Adapters::list()?;
        let context = Context::open(&adapters, adapters.choose(selector)?)?;
        if !context.has(route) {
            return Err(Error::Unsupported { what: format!("{} takes no SPIR-V", context.info.name) });
        }
        Self::on(context, route)
    }

    /// The arithmetic on another route.
    ///
    /// # Errors
    /// When the device fails.
    pub fn fingerprint_on(&self, route: Route) -> Result<Fingerprint, Error> {
        Fingerprint::measure(&self.context, route)
    }

    /// Lowers the largest binding that is used, in bytes, to a power of two of at least 256: to try out scenes that take
    /// more bindings than one.
    pub fn limit_binding(&mut self, bytes: u64) {
        self.context.max_binding = self.context.max_binding.min(bytes.max(256));
    }
}

impl Engine {
    /// The precision `exact` with numbers of one's own choice for its first pass and for the others: to try them out. They must be
    /// ones that the device keeps.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_numbers(gpu: Arc<Gpu>, bvh: &Bvh, first: Width, second: SecondStage) -> Result<Self, Error> {
        match gpu.refuses(Precision::Exact, bvh)? {
            Some(why) => Err(refused(&gpu, Precision::Exact, why)),
            None => Self::exact(gpu, bvh, first, second),
        }
    }

    /// This engine without its tree: every ray is tested with every primitive. It tells what the formulas cost by themselves.
    #[must_use]
    pub fn without_tree(mut self) -> Self {
        self.scene.walk = Walk::Every;
        self
    }

    /// Seconds that kernels have run so far, by the device's own clock; `None` where it has none.
    #[must_use]
    pub fn kernel_seconds(&self) -> Option<f64> {
        let nanoseconds = self.kernel_nanoseconds.load(Relaxed);
        self.gpu.context.has_clock().then(|| Duration::from_nanos(nanoseconds).as_secs_f64())
    }
}
