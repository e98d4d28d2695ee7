//! Opening an adapter, and what every kernel on it needs.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use crate::Error;
use crate::adapter::{choose, driver};
use crate::fingerprint::{Fingerprint, Route};
use crate::float_controls;
use crate::link::Linked;
use crate::second_stage::SecondStage;
use crate::spirv::{self, FloatControls};

/// Which adapter to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// A hardware GPU, a discrete one first; never a software adapter.
    Hardware,
    /// The best there is, a software adapter last.
    Best,
    /// The one of that number in the list.
    Index(usize),
    /// The first whose name holds that text, letter case aside.
    Name(String),
    /// The one on that PCI bus.
    Pci(String),
}

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

/// An open device, with its arithmetic measured.
pub struct Gpu {
    instance: wgpu::Instance,
    adapter: wgpu::Adapter,
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    limits: wgpu::Limits,
    controls: FloatControls,
    route: Route,
    fingerprint: Option<Fingerprint>,
    failure: Arc<Mutex<Option<String>>>,
    max_binding: u64,
    has_f64: bool,
    /// Nanoseconds of a tick of the device's clock, where it has one.
    tick: Option<f32>,
    /// What the second stage of `exact` computes with, once measured.
    second_stage: Mutex<Option<Option<SecondStage>>>,
    /// Kernels by their text and route: scenes share them.
    pipelines: Mutex<HashMap<(String, Route), wgpu::ComputePipeline>>,
}

pub(crate) fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    // Validation layers cost what they find; WGPU_VALIDATION and friends still ask for them.
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    wgpu::Instance::new(descriptor)
}

impl Gpu {
    /// Opens an adapter and measures its arithmetic on the route that kernels take.
    ///
    /// `WGPU_ADAPTER_NAME` narrows [`Selector::Hardware`] and [`Selector::Best`] as it does in every wgpu program.
    ///
    /// # Errors
    /// When there is no such adapter (the message lists those there are), or it cannot be opened.
    pub fn open(selector: &Selector) -> Result<Self, Error> {
        let instance = instance();
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
        let infos: Vec<wgpu::AdapterInfo> = adapters.iter().map(wgpu::Adapter::get_info).collect();
        let index = choose(&infos, selector)?;
        let mut gpu = Self::open_adapter(instance, &adapters[index])?;
        gpu.fingerprint = Some(Fingerprint::measure(&gpu, gpu.route)?);
        Ok(gpu)
    }

    fn open_adapter(instance: wgpu::Instance, adapter: &wgpu::Adapter) -> Result<Self, Error> {
        let wanted = wgpu::Features::PASSTHROUGH_SHADERS | wgpu::Features::SHADER_F64 | wgpu::Features::TIMESTAMP_QUERY;
        let features = adapter.features() & wanted;
        let limits = adapter.limits();
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("rayproof"),
            required_features: features,
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::Performance,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|e| Error::Device(e.to_string()))?;
        let failure = Arc::new(Mutex::new(None));
        let note = |failure: Arc<Mutex<Option<String>>>, text: String| {
            if let Ok(mut slot) = failure.lock() {
                slot.get_or_insert(text);
            }
        };
        let slot = failure.clone();
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| note(slot.clone(), e.to_string())));
        let slot = failure.clone();
        device.set_device_lost_callback(move |reason, text| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                note(slot.clone(), format!("the device was lost: {text}"));
            }
        });
        let route =
            if features.contains(wgpu::Features::PASSTHROUGH_SHADERS) { Route::ExactSpirv } else { Route::PlainWgsl };
        let max_binding = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let controls = float_controls::query(adapter);
        let info = adapter.get_info();
        let tick = features.contains(wgpu::Features::TIMESTAMP_QUERY).then(|| queue.get_timestamp_period());
        Ok(Self {
            instance,
            adapter: adapter.clone(),
            device,
            queue,
            info,
            limits,
            controls,
            route,
            fingerprint: None,
            failure,
            max_binding,
            has_f64: features.contains(wgpu::Features::SHADER_F64),
            tick,
            second_stage: Mutex::default(),
            pipelines: Mutex::default(),
        })
    }

    /// The adapter's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.info.name
    }

    /// The driver and its version.
    #[must_use]
    pub fn driver(&self) -> String {
        driver(&self.info)
    }

    /// Whether a processor runs the kernels.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The device itself, to be shared.
    #[must_use]
    pub fn handles(&self) -> Handles {
        let (instance, adapter) = (self.instance.clone(), self.adapter.clone());
        Handles { instance, adapter, device: self.device.clone(), queue: self.queue.clone() }
    }

    /// How kernels reach the driver.
    #[must_use]
    pub const fn route(&self) -> Route {
        self.route
    }

    /// Makes kernels take another route from now on, to measure what that does; the precision `exact` runs on its own alone.
    ///
    /// # Errors
    /// When the device has no such route.
    pub fn take_route(&mut self, route: Route) -> Result<(), Error> {
        let passes = self.device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS);
        if matches!(route, Route::ExactSpirv | Route::FreeSpirv) && !passes {
            return Err(Error::Device("it takes no SPIR-V".to_owned()));
        }
        self.route = route;
        self.fingerprint = Some(Fingerprint::measure(self, route)?);
        Ok(())
    }

    /// Whether kernels are timed by the device's own clock.
    pub(crate) const fn has_clock(&self) -> bool {
        self.tick.is_some()
    }

    /// Room for two readings of the device's clock.
    pub(crate) fn clock(&self) -> Option<(wgpu::QuerySet, wgpu::Buffer)> {
        self.tick?;
        let descriptor = wgpu::QuerySetDescriptor { label: None, ty: wgpu::QueryType::Timestamp, count: 2 };
        let ticks = self.buffer("ticks", 16, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
        Some((self.device.create_query_set(&descriptor), ticks))
    }

    /// What so many ticks are.
    pub(crate) fn nanoseconds(&self, ticks: u64) -> u64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a duration, to the nanosecond")]
        self.tick.map_or(0, |tick| (ticks as f64 * f64::from(tick)) as u64)
    }

    /// The arithmetic as kernels run it.
    #[must_use]
    pub const fn fingerprint(&self) -> Option<&Fingerprint> {
        self.fingerprint.as_ref()
    }

    /// Lowers the largest binding that is used, in bytes, to a power of two of at least 256: to try out scenes that take
    /// more bindings than one.
    pub fn limit_binding(&mut self, bytes: u64) {
        self.max_binding = self.max_binding.min(bytes.max(256));
    }

    /// What the second stage of `exact` computes with; `None` where nothing keeps its promise, or where kernels run as plain
    /// WGSL: no bound holds where a compiler may reassociate.
    ///
    /// # Errors
    /// When the device fails.
    pub fn second_stage(&self) -> Result<Option<SecondStage>, Error> {
        if self.route != Route::ExactSpirv {
            return Ok(None);
        }
        let mut known =
            self.second_stage.lock().map_err(|_| Error::Device("measuring its numbers panicked".to_owned()))?;
        if let Some(second) = *known {
            return Ok(second);
        }
        Ok(*known.insert(SecondStage::measure(self)?))
    }

    pub(crate) const fn has_f64(&self) -> bool {
        self.has_f64
    }

    pub(crate) const fn limits(&self) -> &wgpu::Limits {
        &self.limits
    }

    pub(crate) const fn max_binding(&self) -> u64 {
        self.max_binding
    }

    /// The first error the driver reported, if any.
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self.failure.lock() {
            Ok(slot) => slot.clone().map_or(Ok(()), |text| Err(Error::Device(text))),
            Err(_) => Err(Error::Device("its error handler panicked".to_owned())),
        }
    }

    /// Waits for a submission and everything before it.
    pub(crate) fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), Error> {
        let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: None };
        self.device.poll(wait).map_err(|e| Error::Device(e.to_string()))?;
        self.check()
    }

    pub(crate) fn buffer(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    pub(crate) fn buffer_with(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        use wgpu::util::DeviceExt as _;
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents: bytes, usage })
    }

    /// Compiles one entry point, or finds it compiled.
    pub(crate) fn pipeline(
        &self,
        linked: &Linked,
        entry: &str,
        layout: &wgpu::BindGroupLayout,
        route: Route,
    ) -> Result<wgpu::ComputePipeline, Error> {
        let broken = |_| Error::Device("compiling a kernel panicked earlier".to_owned());
        let mut pipelines = self.pipelines.lock().map_err(broken)?;
        let key = (linked.source().to_owned(), route);
        if let Some(pipeline) = pipelines.get(&key) {
            return Ok(pipeline.clone());
        }
        let pipeline = self.compile(linked, entry, layout, route)?;
        pipelines.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    fn compile(
        &self,
        linked: &Linked,
        entry: &str,
        layout: &wgpu::BindGroupLayout,
        route: Route,
    ) -> Result<wgpu::ComputePipeline, Error> {
        let (module, info) = linked.validate()?;
        let shader = match route {
            Route::ExactSpirv => self.passthrough(&spirv::exact(&module, &info, self.controls)?, entry, &module),
            Route::FreeSpirv => self.passthrough(&spirv::free(&module, &info)?, entry, &module),
            Route::PlainWgsl => self.plain(linked.source()),
            Route::UncheckedWgsl => self.unchecked(linked.source()),
        };
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(entry),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&layout),
            module: &shader,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        self.check()?;
        Ok(pipeline)
    }

    #[expect(unsafe_code, reason = "wgpu cannot check SPIR-V; naga has validated the module it was written from")]
    fn passthrough(&self, words: &[u32], entry: &str, module: &naga::Module) -> wgpu::ShaderModule {
        let size = module.entry_points.iter().find(|e| e.name == entry).map_or([1; 3], |e| e.workgroup_size);
        let entry_points =
            [wgpu::PassthroughShaderEntryPoint { name: entry.into(), workgroup_size: (size[0], size[1], size[2]) }];
        // SAFETY: the words are naga's translation of a validated module, decorated; indices into the scene come from
        // our own tree and ray indices are compared with the count.
        unsafe {
            self.device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
                label: Some(entry),
                entry_points: entry_points.as_slice().into(),
                spirv: Some(words.into()),
                ..Default::default()
            })
        }
    }

    fn plain(&self, source: &str) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("plain WGSL"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        })
    }

    #[expect(unsafe_code, reason = "wgpu's runtime checks are left out, to measure what they cost")]
    fn unchecked(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some("unchecked WGSL"), source };
        // SAFETY: as for passthrough: indices come from our own tree, or are compared with the count.
        unsafe { self.device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked()) }
    }

    /// Runs a kernel once: its parameters, what it reads, and back what it writes, `count` elements.
    pub(crate) fn run_once<T: bytemuck::Pod>(
        &self,
        pipeline: &wgpu::ComputePipeline,
        layout: &wgpu::BindGroupLayout,
        [params, given]: [&wgpu::Buffer; 2],
        count: usize,
        groups: u32,
    ) -> Result<Vec<T>, Error> {
        use wgpu::BufferUsages as Usage;
        let size = (count * size_of::<T>()) as u64;
        let results = self.buffer("results", size, Usage::STORAGE | Usage::COPY_SRC);
        let readback = self.buffer("readback", size, Usage::MAP_READ | Usage::COPY_DST);
        let unused = self.buffer("unused", 16, Usage::STORAGE);
        let bindings = self.bind(layout, [params, given, &results, &unused]);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups(groups, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&results, 0, &readback, 0, size);
        let submission = self.queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |_| ());
        self.wait(submission)?;
        let view = readback.get_mapped_range(..).map_err(|e| Error::Device(e.to_string()))?;
        Ok(bytemuck::pod_collect_to_vec(&view))
    }

    /// The layout of a kernel's buffers: uniform parameters, one read, two written, then `read` more to read.
    pub(crate) fn layout(&self, read: u32) -> wgpu::BindGroupLayout {
        let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
        let entry = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: match binding {
                    0 => wgpu::BufferBindingType::Uniform,
                    2 | 3 => storage(false),
                    _ => storage(true),
                },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let entries: Vec<_> = (0..4 + read).map(entry).collect();
        self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
    }

    pub(crate) fn bind<'a>(
        &self,
        layout: &wgpu::BindGroupLayout,
        buffers: impl IntoIterator<Item = &'a wgpu::Buffer>,
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    }
}
