//! A device with its arithmetic measured, and the kernels that it has compiled.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use rayproof_scene::Precision;
use rayproof_tree::Bvh;

use crate::Error;
use crate::adapter::{Adapters, Selector, driver};
use crate::context::{Context, Handles};
use crate::fingerprint::Fingerprint;
use crate::link::Linked;
use crate::route::Route;
use crate::second_stage::{SecondStage, Trials};

/// Why `exact` does not run on a device whose numbers fail their trials.
pub(crate) const NO_BOUND: &str = "no bound holds for its arithmetic; see `rayproof devices`";

/// An open device, with its arithmetic measured.
pub struct Gpu {
    pub(crate) context: Context,
    /// On the route that kernels take.
    fingerprint: Fingerprint,
    /// What the second stage of `exact` can compute with: tried when that precision is first asked for, since it takes as long
    /// as a small scene.
    trials: Mutex<Option<Trials>>,
    /// Kernels by their text: scenes share them.
    pipelines: Mutex<HashMap<String, wgpu::ComputePipeline>>,
}

impl Gpu {
    /// Opens an adapter and measures its arithmetic on the route that kernels take.
    ///
    /// `WGPU_ADAPTER_NAME` narrows [`Selector::Hardware`] and [`Selector::Best`] as it does in every wgpu program.
    ///
    /// # Errors
    /// When there is no such adapter (the message lists those there are), or it cannot be opened.
    pub fn open(selector: &Selector) -> Result<Self, Error> {
        let adapters = Adapters::list()?;
        let context = Context::open(&adapters, adapters.choose(selector)?)?;
        let route = context.best_route();
        Self::on(context, route)
    }

    /// Measures an open device, whose kernels are to take a route.
    pub(crate) fn on(context: Context, route: Route) -> Result<Self, Error> {
        let fingerprint = Fingerprint::measure(&context, route)?;
        Ok(Self { context, fingerprint, trials: Mutex::default(), pipelines: Mutex::default() })
    }

    /// The adapter's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.context.info.name
    }

    /// The driver and its version.
    #[must_use]
    pub fn driver(&self) -> String {
        driver(&self.context.info)
    }

    /// Whether a processor runs the kernels.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.context.is_software()
    }

    /// The device itself, to be shared.
    #[must_use]
    pub fn handles(&self) -> Handles {
        self.context.handles.clone()
    }

    /// The arithmetic as kernels run it, and the route that they take.
    #[must_use]
    pub const fn fingerprint(&self) -> &Fingerprint {
        &self.fingerprint
    }

    /// What was tried for the second stage of `exact`.
    ///
    /// # Errors
    /// When the device fails.
    pub fn trials(&self) -> Result<Trials, Error> {
        let mut known = self.trials.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(trials) = &*known {
            return Ok(trials.clone());
        }
        Ok(known.insert(Trials::run(&self.context, self.fingerprint.route)?).clone())
    }

    /// What the second stage of `exact` computes with; `None` where nothing keeps its promise.
    ///
    /// # Errors
    /// When the device fails.
    pub fn second_stage(&self) -> Result<Option<SecondStage>, Error> {
        Ok(self.trials()?.chosen)
    }

    /// Why a precision does not run on this device with a scene, if it does not: its promise would not hold.
    ///
    /// # Errors
    /// When the device fails.
    pub fn refuses(&self, precision: Precision, bvh: &Bvh) -> Result<Option<&'static str>, Error> {
        Ok(match precision {
            Precision::Double if !self.context.has_f64() => Some("it has no f64"),
            Precision::Fast if !self.fingerprint.keeps_subnormals() && !bvh.roomy => {
                Some("it takes subnormal numbers for 0, and the scene's numbers are so far apart that they matter")
            }
            Precision::Exact if !bvh.plain => Some("the scene's numbers are too far apart for bounds in f32"),
            Precision::Exact if self.second_stage()?.is_none() => Some(NO_BOUND),
            _ => None,
        })
    }

    /// Compiles one entry point of a kernel that people call by the second name, or finds it compiled.
    pub(crate) fn pipeline(
        &self,
        linked: &Linked,
        names: [&str; 2],
        layout: &wgpu::BindGroupLayout,
    ) -> Result<wgpu::ComputePipeline, Error> {
        let mut pipelines = self.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pipeline) = pipelines.get(linked.source()) {
            return Ok(pipeline.clone());
        }
        let pipeline = self.context.compile(linked, names, layout, self.fingerprint.route)?;
        pipelines.insert(linked.source().to_owned(), pipeline.clone());
        Ok(pipeline)
    }
}
