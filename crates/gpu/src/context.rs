//! An open device: its handles and limits, and the first thing that went wrong with it.

use std::sync::{Arc, Mutex, PoisonError};

use crate::Error;
use crate::adapter::Adapters;
use crate::float_controls;
use crate::guard::caught;
use crate::route::Route;
use crate::spirv::FloatControls;

/// What another user of an open device, such as a window that paints with it, needs of it.
#[derive(Clone, Debug)]
pub struct Handles {
    /// The Vulkan instance.
    pub instance: wgpu::Instance,
    /// The adapter.
    pub adapter: wgpu::Adapter,
    /// The device, with all limits of the adapter.
    pub device: wgpu::Device,
    /// Its queue, which kernels are submitted to.
    pub queue: wgpu::Queue,
}

/// An open device. What its arithmetic is like is not known here.
pub(crate) struct Context {
    pub(crate) handles: Handles,
    pub(crate) info: wgpu::AdapterInfo,
    pub(crate) limits: wgpu::Limits,
    pub(crate) controls: FloatControls,
    features: wgpu::Features,
    failure: Failure,
    /// The largest storage binding, in bytes.
    pub(crate) max_binding: u64,
    /// Nanoseconds of a tick of the device's clock, where it has one.
    tick: Option<f32>,
}

/// The first error that the driver reported outside any call that was asked for its errors.
#[derive(Clone, Default)]
struct Failure(Arc<Mutex<Option<Error>>>);

impl Failure {
    fn note(&self, error: Error) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    fn get(&self) -> Option<Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Context {
    /// Opens an adapter with what kernels can use of it.
    pub(crate) fn open(adapters: &Adapters, adapter: &wgpu::Adapter) -> Result<Self, Error> {
        let wanted = wgpu::Features::PASSTHROUGH_SHADERS | wgpu::Features::SHADER_F64 | wgpu::Features::TIMESTAMP_QUERY;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("rayproof"),
            required_features: adapter.features() & wanted,
            required_limits: adapter.limits(),
            memory_hints: wgpu::MemoryHints::Performance,
            ..Default::default()
        };
        Self::open_as(adapters, adapter, &descriptor)
    }

    /// Opens an adapter as it is described.
    pub(crate) fn open_as(
        adapters: &Adapters,
        adapter: &wgpu::Adapter,
        descriptor: &wgpu::DeviceDescriptor<'_>,
    ) -> Result<Self, Error> {
        let (device, queue) = caught(|| pollster::block_on(adapter.request_device(descriptor)))??;
        let failure = Failure::default();
        let slot = failure.clone();
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| slot.note(e.into())));
        let slot = failure.clone();
        device.set_device_lost_callback(move |reason, text| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                slot.note(Error::of_loss(text));
            }
        });
        let (features, limits) = (descriptor.required_features, descriptor.required_limits.clone());
        let max_binding = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let tick = features.contains(wgpu::Features::TIMESTAMP_QUERY).then(|| queue.get_timestamp_period());
        let (info, controls) = (adapter.get_info(), float_controls::query(adapter));
        let handles = Handles { instance: adapters.instance.clone(), adapter: adapter.clone(), device, queue };
        Ok(Self { handles, info, limits, controls, features, failure, max_binding, tick })
    }

    pub(crate) const fn device(&self) -> &wgpu::Device {
        &self.handles.device
    }

    /// Whether a processor runs the kernels.
    pub(crate) fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    pub(crate) const fn has_f64(&self) -> bool {
        self.features.contains(wgpu::Features::SHADER_F64)
    }

    /// The route that keeps most of what kernels say.
    pub(crate) const fn best_route(&self) -> Route {
        if self.has(Route::ExactSpirv) { Route::ExactSpirv } else { Route::PlainWgsl }
    }

    /// Whether kernels can take a route.
    pub(crate) const fn has(&self, route: Route) -> bool {
        !route.is_spirv() || self.features.contains(wgpu::Features::PASSTHROUGH_SHADERS)
    }

    /// Whether kernels are timed by the device's own clock.
    #[cfg(feature = "measure")]
    pub(crate) const fn has_clock(&self) -> bool {
        self.tick.is_some()
    }

    /// Room for two readings of the device's clock.
    pub(crate) fn clock(&self) -> Option<(wgpu::QuerySet, wgpu::Buffer)> {
        self.tick?;
        let descriptor = wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count: 2 };
        let ticks = self.buffer("ticks", 16, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
        Some((self.device().create_query_set(&descriptor), ticks))
    }

    /// What so many ticks are.
    pub(crate) fn nanoseconds(&self, ticks: u64) -> u64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a duration, to the nanosecond")]
        self.tick.map_or(0, |tick| (ticks as f64 * f64::from(tick)) as u64)
    }

    /// Makes things on the device; what goes wrong meanwhile is this call's error, and the device goes on.
    pub(crate) fn making<T>(&self, make: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        use wgpu::ErrorFilter::{Internal, OutOfMemory, Validation};
        let scopes = [Internal, Validation, OutOfMemory].map(|kind| self.device().push_error_scope(kind));
        // wgpu panics where it maps a buffer that there was no memory for.
        let made = caught(make);
        // A lack of memory is what the others come from.
        let errors = scopes.into_iter().rev().map(|scope| pollster::block_on(scope.pop())).collect::<Vec<_>>();
        match errors.into_iter().flatten().next() {
            Some(error) => Err(error.into()),
            None => {
                self.check()?;
                made?
            }
        }
    }

    /// The first error that the driver reported, if any.
    pub(crate) fn check(&self) -> Result<(), Error> {
        self.failure.get().map_or(Ok(()), Err)
    }

    /// Waits for a submission and everything before it.
    pub(crate) fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), Error> {
        let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: None };
        // wgpu panics where the device is lost meanwhile; why, the driver has said before.
        let waited = caught(|| self.device().poll(wait));
        self.check()?;
        match waited? {
            Ok(_) => Ok(()),
            Err(wgpu::PollError::Timeout) => Err(Error::Driver { what: "a kernel does not end".to_owned() }),
            Err(error) => Err(Error::Refused { what: error.to_string() }),
        }
    }
}
