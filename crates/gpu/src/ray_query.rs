//! The device's own ray query, to be measured beside ours: hardware's answer, as a user of wgpu gets it.

use std::time::Instant;

use rayproof_scene::{FlatHit, Mesh, Ray};

use crate::Error;
use crate::adapter::{Adapters, Selector, driver};
use crate::compute::WORKGROUP;
use crate::context::Context;

/// Rays a dispatch.
const CHUNK: usize = 1 << 18;

/// A mesh in the device's own tree.
pub struct RayQuery {
    context: Context,
    pipeline: wgpu::ComputePipeline,
    tree: wgpu::Tlas,
    build_seconds: f64,
}

impl RayQuery {
    /// Builds the tree on an adapter that has ray queries.
    ///
    /// # Errors
    /// When there is no such adapter, it has no ray query ([`Error::Unsupported`]), or it fails.
    pub fn new(selector: &Selector, mesh: &Mesh) -> Result<Self, Error> {
        let adapters = Adapters::list()?;
        let context = open(&adapters, adapters.choose(selector)?)?;
        let start = Instant::now();
        let (tree, built) = context.making(|| tree(&context, mesh))?;
        context.wait(built)?;
        let build_seconds = start.elapsed().as_secs_f64();
        let pipeline = context.making(|| Ok(pipeline(context.device())))?;
        Ok(Self { context, pipeline, tree, build_seconds })
    }

    /// The driver and its version.
    #[must_use]
    pub fn driver(&self) -> String {
        driver(&self.context.info)
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
        let size = size_of_val(hits) as u64;
        let (readback, submission) = self.context.making(|| Ok(self.launch(rays, size)))?;
        self.context.wait(submission)?;
        let found = self.context.read(&readback, size, bytemuck::pod_collect_to_vec::<u8, FlatHit>)?;
        hits.copy_from_slice(&found);
        Ok(())
    }

    /// Asks about rays; the answers come to the buffer that is returned.
    fn launch(&self, rays: &[Ray], size: u64) -> (wgpu::Buffer, wgpu::SubmissionIndex) {
        use wgpu::BufferUsages as Usage;
        let context = &self.context;
        let count = u32::try_from(rays.len()).expect("no more than CHUNK");
        let row = count.div_ceil(WORKGROUP);
        let params = context.buffer_with("params", bytemuck::cast_slice(&[count, row, 0, 0]), Usage::UNIFORM);
        let given = context.buffer_with("rays", bytemuck::cast_slice(rays), Usage::STORAGE);
        let found = context.buffer("hits", size, Usage::STORAGE | Usage::COPY_SRC);
        let readback = context.buffer("readback", size, Usage::MAP_READ | Usage::COPY_DST);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bindings = context.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                entry(0, params.as_entire_binding()),
                entry(1, given.as_entire_binding()),
                entry(2, found.as_entire_binding()),
                entry(3, self.tree.as_binding()),
            ],
        });
        let mut encoder = context.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups(row, 1, 1);
        }
        encoder.copy_buffer_to_buffer(&found, 0, &readback, 0, size);
        let submission = context.handles.queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |_| ());
        (readback, submission)
    }
}

#[expect(unsafe_code, reason = "wgpu asks for it: its ray queries are experimental")]
fn open(adapters: &Adapters, adapter: &wgpu::Adapter) -> Result<Context, Error> {
    let features = wgpu::Features::EXPERIMENTAL_RAY_QUERY;
    if !adapter.features().contains(features) {
        return Err(Error::Unsupported { what: format!("{} has no ray query", adapter.get_info().name) });
    }
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("ray query"),
        required_features: features,
        required_limits: adapter.limits(),
        // SAFETY: what may go wrong there is undefined behaviour of the driver; it is measured only where a user asks for peers.
        experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
        ..Default::default()
    };
    Context::open_as(adapters, adapter, &descriptor)
}

/// The mesh in one bottom level, opaque, and that once in the top level.
fn tree(context: &Context, mesh: &Mesh) -> Result<(wgpu::Tlas, wgpu::SubmissionIndex), Error> {
    let (device, usage) = (context.device(), wgpu::BufferUsages::BLAS_INPUT);
    let vertices = context.buffer_with("vertices", bytemuck::cast_slice(&mesh.vertices), usage);
    let indices = context.buffer_with("indices", bytemuck::cast_slice(&mesh.triangles), usage);
    let count = |n: usize| u32::try_from(n).map_err(|_| Error::TooLarge { what: "it has 2^32 indices".to_owned() });
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
    let built = context.handles.queue.submit([encoder.finish()]);
    Ok((tlas, built))
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
