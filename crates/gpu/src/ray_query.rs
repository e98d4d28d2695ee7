//! The device's own ray query, to be measured beside ours: hardware's answer, as a user of wgpu gets it.

use std::time::Instant;

use rayproof_scene::{FlatHit, Mesh, Ray};

use crate::Error;
use crate::adapter::{choose, driver};
use crate::gpu::{Selector, instance};

/// Rays a dispatch.
const CHUNK: usize = 1 << 18;

/// A mesh in the device's own tree.
pub struct RayQuery {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    tree: wgpu::Tlas,
    driver: String,
    build_seconds: f64,
}

impl RayQuery {
    /// Builds the tree on an adapter that has ray queries.
    ///
    /// # Errors
    /// When there is no such adapter, it has no ray query, or it fails.
    pub fn new(selector: &Selector, mesh: &Mesh) -> Result<Self, Error> {
        let adapters = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::VULKAN));
        let infos: Vec<wgpu::AdapterInfo> = adapters.iter().map(wgpu::Adapter::get_info).collect();
        let index = choose(&infos, selector)?;
        let (device, queue) = open(&adapters[index])?;
        let lost = std::sync::Arc::new(std::sync::Mutex::new(None));
        let slot = lost.clone();
        device.on_uncaptured_error(std::sync::Arc::new(move |e: wgpu::Error| {
            if let Ok(mut slot) = slot.lock() {
                slot.get_or_insert(e.to_string());
            }
        }));
        let start = Instant::now();
        let tree = tree(&device, &queue, mesh)?;
        let build_seconds = start.elapsed().as_secs_f64();
        let pipeline = pipeline(&device);
        match lost.lock().ok().and_then(|mut slot| slot.take()) {
            Some(text) => Err(Error::Device(text)),
            None => Ok(Self { device, queue, pipeline, tree, driver: driver(&infos[index]), build_seconds }),
        }
    }

    /// The driver and its version.
    #[must_use]
    pub fn driver(&self) -> &str {
        &self.driver
    }

    /// Seconds that building the tree took.
    #[must_use]
    pub const fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    /// The closest hit of each ray, primitives as the mesh numbers them.
    ///
    /// # Errors
    /// When the device fails.
    pub fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<(), Error> {
        for (rays, hits) in rays.chunks(CHUNK).zip(hits.chunks_mut(CHUNK)) {
            self.chunk(rays, hits)?;
        }
        Ok(())
    }

    fn chunk(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<(), Error> {
        use wgpu::BufferUsages as Usage;
        use wgpu::util::DeviceExt as _;
        let filled = |contents: &[u8], usage| {
            self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
        let row = count.div_ceil(64);
        let params = filled(bytemuck::cast_slice(&[count, row, 0, 0]), Usage::UNIFORM);
        let given = filled(bytemuck::cast_slice(rays), Usage::STORAGE);
        let size = size_of_val(hits) as u64;
        let buffer = |usage| {
            self.device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
        };
        let (found, readback) = (buffer(Usage::STORAGE | Usage::COPY_SRC), buffer(Usage::MAP_READ | Usage::COPY_DST));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bindings = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                entry(0, params.as_entire_binding()),
                entry(1, given.as_entire_binding()),
                entry(2, found.as_entire_binding()),
                entry(3, self.tree.as_binding()),
            ],
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups(row, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&found, 0, &readback, 0, size);
        self.queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |_| ());
        let failed = |e: &dyn std::fmt::Display| Error::Device(e.to_string());
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| failed(&e))?;
        let view = readback.get_mapped_range(..).map_err(|e| failed(&e))?;
        hits.copy_from_slice(&bytemuck::pod_collect_to_vec::<u8, FlatHit>(&view));
        Ok(())
    }
}

#[expect(unsafe_code, reason = "wgpu asks for it: its ray queries are experimental")]
fn open(adapter: &wgpu::Adapter) -> Result<(wgpu::Device, wgpu::Queue), Error> {
    let features = wgpu::Features::EXPERIMENTAL_RAY_QUERY;
    if !adapter.features().contains(features) {
        return Err(Error::Device(format!("{} has no ray query", adapter.get_info().name)));
    }
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("ray query"),
        required_features: features,
        required_limits: adapter.limits(),
        // SAFETY: what may go wrong there is undefined behaviour of the driver; it is measured only where a user asks for peers.
        experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
        ..Default::default()
    };
    pollster::block_on(adapter.request_device(&descriptor)).map_err(|e| Error::Device(e.to_string()))
}

/// The mesh in one bottom level, opaque, and that once in the top level.
fn tree(device: &wgpu::Device, queue: &wgpu::Queue, mesh: &Mesh) -> Result<wgpu::Tlas, Error> {
    use wgpu::util::DeviceExt as _;
    let filled = |contents: &[u8]| {
        let usage = wgpu::BufferUsages::BLAS_INPUT;
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let vertices = filled(bytemuck::cast_slice(&mesh.vertices));
    let indices = filled(bytemuck::cast_slice(&mesh.triangles));
    let count = |n: usize| u32::try_from(n).map_err(|_| Error::TooLarge("2^32 indices".to_owned()));
    let size = wgpu::BlasTriangleGeometrySizeDescriptor {
        vertex_format: wgpu::VertexFormat::Float32x3,
        vertex_count: count(mesh.vertices.len())?,
        index_format: Some(wgpu::IndexFormat::Uint32),
        index_count: Some(count(mesh.triangles.len() * 3)?),
        flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
    };
    let (flags, update_mode) =
        (wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE, wgpu::AccelerationStructureUpdateMode::Build);
    let blas = device.create_blas(
        &wgpu::CreateBlasDescriptor { label: None, flags, update_mode },
        wgpu::BlasGeometrySizeDescriptors::Triangles { descriptors: vec![size.clone()] },
    );
    let mut tlas =
        device.create_tlas(&wgpu::CreateTlasDescriptor { label: None, max_instances: 1, flags, update_mode });
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    tlas[0] = Some(wgpu::TlasInstance::new(&blas, identity, 0, 0xff));
    let geometry = wgpu::BlasTriangleGeometry {
        size: &size,
        vertex_buffer: &vertices,
        first_vertex: 0,
        vertex_stride: 12,
        index_buffer: Some(&indices),
        first_index: Some(0),
        transform_buffer: None,
        transform_buffer_offset: None,
    };
    let entry =
        wgpu::BlasBuildEntry { blas: &blas, geometry: wgpu::BlasGeometries::TriangleGeometries(vec![geometry]) };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.build_acceleration_structures([&entry], [&tlas]);
    queue.submit([encoder.finish()]);
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| Error::Device(e.to_string()))?;
    Ok(tlas)
}

fn pipeline(device: &wgpu::Device) -> wgpu::ComputePipeline {
    let source = wgpu::ShaderSource::Wgsl(rayproof_shaders::source("ray_query.wgsl").into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("query_closest"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}
