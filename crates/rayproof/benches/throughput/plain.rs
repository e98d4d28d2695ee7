//! The yardstick on the device: `plain.wgsl` through wgpu's own compiler, without its runtime checks.
#![expect(unsafe_code, reason = "the yardstick runs without wgpu's runtime checks, as its published figures did")]

use std::time::{Duration, Instant};

use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;
use rayproof::scene::{Geometry, Ray, Scene};

use crate::engines::Contestant;

pub(crate) const NAME: &str = "plain kernel on gpu";

/// Nodes of 32 bytes, triangles of 48.
type Tree = (Vec<[u32; 8]>, Vec<[f32; 12]>);

/// obvhs's tree, medium build, in the kernel's layout: 32 bytes a node, 48 a triangle in leaf order.
fn tree(scene: &Scene) -> anyhow::Result<Tree> {
    let [Geometry::Mesh(mesh)] = scene.geometries() else { anyhow::bail!("one mesh only") };
    let triangles: Vec<Triangle> = (0..mesh.triangles.len())
        .map(|i| mesh.triangle(i))
        .map(|t| Triangle { v0: t.a.into(), v1: t.b.into(), v2: t.c.into() })
        .collect();
    let bvh = build_bvh2_from_tris(&triangles, obvhs::BvhBuildParams::medium_build(), &mut Duration::default());
    let nodes = bvh.nodes.iter().map(|n| {
        let (low, high) = (n.aabb.min, n.aabb.max);
        let bits = f32::to_bits;
        [bits(low.x), bits(low.y), bits(low.z), n.first_index, bits(high.x), bits(high.y), bits(high.z), n.prim_count]
    });
    let vertices = bvh.primitive_indices.iter().map(|&i| {
        let t = &triangles[i as usize];
        [t.v0.x, t.v0.y, t.v0.z, 0.0, t.v1.x, t.v1.y, t.v1.z, 0.0, t.v2.x, t.v2.y, t.v2.z, 0.0]
    });
    Ok((nodes.collect(), vertices.collect()))
}

pub(crate) fn kernel(scene: &Scene) -> anyhow::Result<Contestant> {
    use wgpu::BufferUsages as Usage;
    use wgpu::util::DeviceExt as _;
    let start = Instant::now();
    let (nodes, vertices) = tree(scene)?;
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    descriptor.flags = wgpu::InstanceFlags::empty();
    let adapters = pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(wgpu::Backends::VULKAN));
    let adapter = adapters.first().ok_or_else(|| anyhow::anyhow!("no Vulkan adapter"))?;
    let (device, queue) = pollster::block_on(
        adapter.request_device(&wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() }),
    )?;
    let source = wgpu::ShaderSource::Wgsl(include_str!("plain.wgsl").into());
    let descriptor = wgpu::ShaderModuleDescriptor { label: None, source };
    // SAFETY: every index in the kernel comes from the tree made above or is compared with the batch's length.
    let module = unsafe { device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked()) };
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("closest"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let filled = |bytes: &[u8]| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytes,
            usage: Usage::STORAGE,
        })
    };
    let (nodes, vertices) = (filled(bytemuck::cast_slice(&nodes)), filled(bytemuck::cast_slice(&vertices)));
    let seconds = start.elapsed().as_secs_f64();
    let detail = adapter.get_info().name;
    let empty = move |device: &wgpu::Device, size: u64, usage| {
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    };
    let buffers = std::cell::OnceCell::new();
    let trace = move |batch: &[Ray]| {
        let size = size_of_val(batch) as u64;
        let (rays, hits, readback) = buffers.get_or_init(|| {
            (
                empty(&device, size, Usage::STORAGE | Usage::COPY_DST),
                empty(&device, size / 2, Usage::STORAGE | Usage::COPY_SRC),
                empty(&device, size / 2, Usage::MAP_READ | Usage::COPY_DST),
            )
        });
        anyhow::ensure!(rays.size() == size, "every batch has the first one's size");
        let bound = [rays, hits, &nodes, &vertices];
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(bound)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let layout = pipeline.get_bind_group_layout(0);
        let group =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        queue.write_buffer(rays, 0, bytemuck::cast_slice(batch));
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(u32::try_from(batch.len())?.div_ceil(64), 1, 1);
        }
        encoder.copy_buffer_to_buffer(hits, 0, readback, 0, size / 2);
        queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |_| ());
        device.poll(wgpu::PollType::wait_indefinitely())?;
        let copy: Vec<[u32; 4]> = bytemuck::pod_collect_to_vec(&readback.get_mapped_range(..)?);
        readback.unmap();
        anyhow::ensure!(copy.len() == batch.len() && copy.iter().any(|hit| hit[3] != u32::MAX), "it hits something");
        Ok(rayproof::scene::Undecided::default())
    };
    Ok(Contestant { name: NAME, detail, seconds, peer: None, trace: Box::new(trace) })
}
