//! Kernels and buffers of an open device: compiled, bound, and run once.

use crate::Error;
use crate::context::Context;
use crate::dump;
use crate::error::causes;
use crate::link::Linked;
use crate::route::Route;
use crate::spirv;

/// Threads of a workgroup; `WORKGROUP_SIZE` in `shaders/batch.wgsl`.
pub(crate) const WORKGROUP: u32 = 64;

/// A kernel that needs no scene: it reads one list and writes another.
pub(crate) struct Alone {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl Context {
    pub(crate) fn buffer(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    pub(crate) fn buffer_with(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        use wgpu::util::DeviceExt as _;
        let descriptor = wgpu::util::BufferInitDescriptor { label: Some(label), contents: bytes, usage };
        self.device().create_buffer_init(&descriptor)
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
        self.device().create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
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
        self.device().create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    }

    /// Compiles one entry point of a kernel that people call `name`.
    pub(crate) fn compile(
        &self,
        linked: &Linked,
        [entry, name]: [&str; 2],
        layout: &wgpu::BindGroupLayout,
        route: Route,
    ) -> Result<wgpu::ComputePipeline, Error> {
        let (module, info) = linked.validate()?;
        let spirv = match route {
            Route::ExactSpirv => Some(spirv::exact(&module, &info, self.controls)?),
            Route::PlainWgsl => None,
            #[cfg(feature = "measure")]
            Route::FreeSpirv => Some(spirv::free(&module, &info)?),
            #[cfg(feature = "measure")]
            Route::UncheckedWgsl => None,
        };
        if let Some(folder) = dump::folder() {
            dump::write(&folder, name, route, linked.source(), spirv.as_deref())?;
        }
        self.making(|| {
            let shader = match (&spirv, route) {
                (Some(words), _) => self.passthrough(words, entry, &module),
                #[cfg(feature = "measure")]
                (None, Route::UncheckedWgsl) => self.unchecked(linked.source()),
                (None, _) => self.plain(linked.source()),
            };
            let layout = self.device().create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(entry),
                bind_group_layouts: &[Some(layout)],
                immediate_size: 0,
            });
            Ok(self.device().create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry),
                layout: Some(&layout),
                module: &shader,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            }))
        })
    }

    #[expect(unsafe_code, reason = "wgpu cannot check SPIR-V; naga has validated the module it was written from")]
    fn passthrough(&self, words: &[u32], entry: &str, module: &naga::Module) -> wgpu::ShaderModule {
        let size = module.entry_points.iter().find(|e| e.name == entry).map_or([1; 3], |e| e.workgroup_size);
        let entry_points =
            [wgpu::PassthroughShaderEntryPoint { name: entry.into(), workgroup_size: (size[0], size[1], size[2]) }];
        // SAFETY: the words are naga's translation of a validated module, decorated; indices into the scene come from
        // our own tree and ray indices are compared with the count.
        unsafe {
            self.device().create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
                label: Some(entry),
                entry_points: entry_points.as_slice().into(),
                spirv: Some(words.into()),
                ..Default::default()
            })
        }
    }

    fn plain(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        self.device().create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("plain WGSL"), source })
    }

    #[cfg(feature = "measure")]
    #[expect(unsafe_code, reason = "wgpu's runtime checks are left out, to measure what they cost")]
    fn unchecked(&self, source: &str) -> wgpu::ShaderModule {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        let descriptor = wgpu::ShaderModuleDescriptor { label: Some("unchecked WGSL"), source };
        // SAFETY: as for passthrough: indices come from our own tree, or are compared with the count.
        unsafe { self.device().create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked()) }
    }

    /// Compiles a kernel that needs no scene.
    pub(crate) fn compile_alone(&self, linked: &Linked, names: [&str; 2], route: Route) -> Result<Alone, Error> {
        let layout = self.layout(0);
        Ok(Alone { pipeline: self.compile(linked, names, &layout, route)?, layout })
    }

    /// Runs such a kernel once in so many threads, with two parameters and what it reads; returned are the `count` elements that
    /// it writes.
    pub(crate) fn run_once<T: bytemuck::Pod>(
        &self,
        kernel: &Alone,
        [first, second]: [u32; 2],
        given: &[u8],
        count: usize,
        threads: u32,
    ) -> Result<Vec<T>, Error> {
        use wgpu::BufferUsages as Usage;
        let size = (count * size_of::<T>()) as u64;
        let (readback, submission) = self.making(|| {
            let params = self.buffer_with("params", bytemuck::cast_slice(&[first, second, 0, 0]), Usage::UNIFORM);
            let given = self.buffer_with("given", given, Usage::STORAGE);
            let results = self.buffer("results", size, Usage::STORAGE | Usage::COPY_SRC);
            let readback = self.buffer("readback", size, Usage::MAP_READ | Usage::COPY_DST);
            let unused = self.buffer("unused", 16, Usage::STORAGE);
            let bindings = self.bind(&kernel.layout, [&params, &given, &results, &unused]);
            let mut encoder = self.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(0, &bindings, &[]);
                pass.dispatch_workgroups(threads.div_ceil(WORKGROUP), 1, 1);
            }
            encoder.copy_buffer_to_buffer(&results, 0, &readback, 0, size);
            let submission = self.handles.queue.submit([encoder.finish()]);
            readback.map_async(wgpu::MapMode::Read, .., |_| ());
            Ok((readback, submission))
        })?;
        self.wait(submission)?;
        self.read(&readback, size, bytemuck::pod_collect_to_vec)
    }

    /// Hands over the first `size` bytes of a buffer that is mapped.
    pub(crate) fn read<T>(&self, buffer: &wgpu::Buffer, size: u64, take: impl FnOnce(&[u8]) -> T) -> Result<T, Error> {
        let lost =
            |e: wgpu::MapRangeError| Error::Driver { what: format!("results cannot be read back: {}", causes(&e)) };
        Ok(take(&buffer.get_mapped_range(0..size).map_err(lost)?))
    }
}
