//! Rays through a kernel: in chunks, uploads and readbacks overlapped with work.

use std::sync::mpsc;
use std::time::{Duration, Instant};

use bytemuck::{Pod, Zeroable};
use rayproof_scene::Ray;

use crate::Error;
use crate::engine::OnDevice;
use crate::gpu::Gpu;
use crate::kernel::{Kernel, Query};

/// Threads of a workgroup; `WORKGROUP_SIZE` in `shaders/batch.wgsl`.
const WORKGROUP: u32 = 64;

/// Chunks in flight: one uploading, one at work, one coming back.
const SLOTS: usize = 3;

/// Rays of the first chunk, and of the largest: by default; a device's limits can lower both.
const FIRST_CHUNK: usize = 1 << 16;
const LARGEST_CHUNK: usize = 1 << 20;

/// A chunk should keep the device busy for about this long: well above the cost of a submission, well below the second
/// or two after which a desktop's driver resets a device.
const CHUNK_TIME: Duration = Duration::from_millis(100);

/// What every ray of a dispatch shares; `Params` in `shaders/batch.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Params {
    ray_count: u32,
    row: u32,
    scene_exponent: i32,
    scene_size: f32,
}

/// A kernel with its buffers.
pub(crate) struct Stream {
    pipeline: wgpu::ComputePipeline,
    slots: Vec<Slot>,
    query: Query,
    /// Limits and time both cut: what the buffers hold, and what takes about [`CHUNK_TIME`].
    capacity: usize,
    chunk: usize,
    widest: u32,
    scene_exponent: i32,
    scene_size: f32,
}

struct Slot {
    params: wgpu::Buffer,
    rays: wgpu::Buffer,
    hits: wgpu::Buffer,
    readback: wgpu::Buffer,
    bindings: wgpu::BindGroup,
}

/// A chunk on its way.
struct Flight {
    slot: usize,
    at: usize,
    count: usize,
    submission: wgpu::SubmissionIndex,
    mapped: mpsc::Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl Stream {
    pub(crate) fn new(gpu: &Gpu, scene: &OnDevice, kernel: Kernel) -> Result<Self, Error> {
        use wgpu::BufferUsages as Usage;
        let layout = gpu.layout(u32::try_from(scene.buffers.len()).unwrap_or(u32::MAX));
        let pipeline = gpu.pipeline(&kernel.link(&scene.accessors), kernel.query.entry(), &layout, gpu.route())?;
        let widest = gpu.limits().max_compute_workgroups_per_dimension;
        let most = usize::try_from(gpu.max_binding() / size_of::<Ray>() as u64).unwrap_or(usize::MAX);
        let capacity = LARGEST_CHUNK.min(most).max(1);
        let (rays, hits) = ((capacity * size_of::<Ray>()) as u64, capacity as u64 * kernel.query.answer_size());
        let slot = || {
            let params = gpu.buffer("params", size_of::<Params>() as u64, Usage::UNIFORM | Usage::COPY_DST);
            let rays = gpu.buffer("rays", rays, Usage::STORAGE | Usage::COPY_DST);
            let readback = gpu.buffer("readback", hits, Usage::MAP_READ | Usage::COPY_DST);
            let hits = gpu.buffer("hits", hits, Usage::STORAGE | Usage::COPY_SRC);
            let bindings = gpu.bind(&layout, [&params, &rays, &hits].into_iter().chain(&scene.buffers));
            Slot { params, rays, hits, readback, bindings }
        };
        let slots = (0..SLOTS).map(|_| slot()).collect();
        gpu.check()?;
        Ok(Self {
            pipeline,
            slots,
            query: kernel.query,
            capacity,
            chunk: FIRST_CHUNK.min(capacity),
            widest,
            scene_exponent: scene.scale_exponent,
            scene_size: scene.size,
        })
    }

    /// Answers all rays; `take` is given each chunk's first ray and its answers' bytes, in order.
    pub(crate) fn run(&mut self, gpu: &Gpu, rays: &[Ray], mut take: impl FnMut(usize, &[u8])) -> Result<(), Error> {
        let mut flights = std::collections::VecDeque::with_capacity(SLOTS);
        let (mut at, mut slot) = (0, 0);
        let mut last_done = Instant::now();
        while at < rays.len() || !flights.is_empty() {
            if at < rays.len() && flights.len() < SLOTS {
                let count = self.chunk.min(rays.len() - at);
                flights.push_back(self.launch(gpu, slot, at, &rays[at..at + count])?);
                at += count;
                slot = (slot + 1) % SLOTS;
                continue;
            }
            let Some(flight) = flights.pop_front() else { break };
            self.land(gpu, &flight, &mut take)?;
            self.adapt(flight.count, last_done.elapsed());
            last_done = Instant::now();
        }
        Ok(())
    }

    fn launch(&self, gpu: &Gpu, slot: usize, at: usize, rays: &[Ray]) -> Result<Flight, Error> {
        let Slot { params, rays: buffer, hits, readback, bindings } = &self.slots[slot];
        let ray_count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
        let groups = ray_count.div_ceil(WORKGROUP);
        let row = groups.min(self.widest);
        let given =
            Params { ray_count, row, scene_exponent: self.scene_exponent, scene_size: self.scene_size };
        gpu.queue.write_buffer(params, 0, bytemuck::bytes_of(&given));
        gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(rays));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, bindings, &[]);
            pass.dispatch_workgroups(row, groups.div_ceil(row.max(1)), 1);
        }
        let bytes = rays.len() as u64 * self.query.answer_size();
        encoder.copy_buffer_to_buffer(hits, 0, readback, 0, bytes);
        let submission = gpu.queue.submit([encoder.finish()]);
        let (sender, mapped) = mpsc::channel();
        readback.map_async(wgpu::MapMode::Read, 0..bytes, move |result| {
            // The receiver is gone only when the batch was given up.
            let _ = sender.send(result);
        });
        gpu.check()?;
        Ok(Flight { slot, at, count: rays.len(), submission, mapped })
    }

    fn land(&self, gpu: &Gpu, flight: &Flight, take: &mut impl FnMut(usize, &[u8])) -> Result<(), Error> {
        gpu.wait(flight.submission.clone())?;
        let lost = |e: &dyn std::fmt::Display| Error::Device(format!("hits could not be read back: {e}"));
        flight.mapped.recv().map_err(|e| lost(&e))?.map_err(|e| lost(&e))?;
        let readback = &self.slots[flight.slot].readback;
        let bytes = flight.count as u64 * self.query.answer_size();
        {
            let view = readback.get_mapped_range(0..bytes).map_err(|e| lost(&e))?;
            take(flight.at, &view);
        }
        readback.unmap();
        Ok(())
    }

    /// Doubles or halves the chunk towards [`CHUNK_TIME`].
    fn adapt(&mut self, count: usize, took: Duration) {
        let chunk = self.chunk;
        if took > 2 * CHUNK_TIME && count == chunk {
            self.chunk = (chunk / 2).max(WORKGROUP as usize);
        } else if took < CHUNK_TIME / 2 && count == chunk {
            self.chunk = (chunk * 2).min(self.capacity);
        }
    }
}
