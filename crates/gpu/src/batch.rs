//! Rays through a kernel: in chunks, uploads and readbacks overlapped with work.

use std::sync::mpsc;
use std::time::{Duration, Instant};

use bytemuck::{Pod, Zeroable};
use rayproof_scene::Ray;

use crate::Error;
use crate::compute::WORKGROUP;
use crate::context::Context;
use crate::dump;
use crate::engine::OnDevice;
use crate::error::causes;
use crate::gpu::Gpu;
use crate::kernel::{Kernel, Listed, Pass, Query, Walk};

/// Chunks in flight: one uploading, one at work, one coming back.
const SLOTS: usize = 3;

/// Rays of the first chunk, and of the largest; a device's limits can lower both.
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

/// The head of the list in `shaders/exact/list.wgsl` before the first pass: two counters, then for each of the two lists the
/// workgroups that take it, as an indirect dispatch wants them.
const HEAD: [u32; 8] = [0, 0, 0, 1, 1, 0, 1, 1];

/// The two counters, in a readback.
const COUNTERS: u64 = 8;

/// What an indirect dispatch reads.
const INDIRECT: u64 = 12;

/// The device's clock before and after the kernels, in a readback.
const TICKS: u64 = 16;

/// What follows the answers in a readback.
const TAIL: u64 = COUNTERS + TICKS;

/// The kernels of a query, one after the other, with their buffers.
pub(crate) struct Stream {
    passes: Vec<(wgpu::ComputePipeline, Pass)>,
    layout: wgpu::BindGroupLayout,
    slots: Vec<Slot>,
    query: Query,
    /// The most rays a chunk can have: the device's limits.
    most: usize,
    /// The rays that the slots have room for.
    capacity: usize,
    /// The rays of the next chunk: what takes about [`CHUNK_TIME`].
    chunk: usize,
    widest: u32,
}

struct Slot {
    params: wgpu::Buffer,
    rays: wgpu::Buffer,
    hits: wgpu::Buffer,
    list: wgpu::Buffer,
    /// The workgroups of a pass over a list, whose length only the device knows: a copy, since kernels write the list itself.
    groups: wgpu::Buffer,
    readback: wgpu::Buffer,
    /// Where the device has a clock: the two readings, and the buffer that they come out to.
    clock: Option<(wgpu::QuerySet, wgpu::Buffer)>,
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
    pub(crate) fn new(gpu: &Gpu, scene: &OnDevice, query: Query, passes: &[Pass]) -> Result<Self, Error> {
        let layout = gpu.context.layout(u32::try_from(scene.buffers.len()).expect("no more than a kernel can bind"));
        let compile = |&pass: &Pass| -> Result<_, Error> {
            let kernel = Kernel { pass, query, kinds: scene.kinds, walk: scene.walk };
            let host = match scene.walk {
                Walk::Tree => scene.accessors.clone(),
                Walk::Every => format!("{}const NODE_COUNT: u32 = {}u;\n", scene.accessors, scene.nodes),
            };
            let names = [kernel.entry(), &dump::name(&kernel)];
            Ok((gpu.pipeline(&kernel.link(&host), names, &layout)?, pass))
        };
        let passes = passes.iter().map(compile).collect::<Result<Vec<_>, Error>>()?;
        let widest = gpu.context.limits.max_compute_workgroups_per_dimension;
        let most = (LARGEST_CHUNK as u64).min(gpu.context.max_binding / size_of::<Ray>() as u64).max(1);
        let most = usize::try_from(most).expect("no more than LARGEST_CHUNK");
        let (slots, chunk) = (Vec::new(), FIRST_CHUNK.min(most));
        Ok(Self { passes, layout, slots, query, most, capacity: 0, chunk, widest })
    }

    /// Makes room for chunks of a batch of `rays`.
    fn reserve(&mut self, context: &Context, scene: &OnDevice, rays: usize) -> Result<(), Error> {
        use wgpu::BufferUsages as Usage;
        let wanted = rays.checked_next_power_of_two().unwrap_or(self.most).min(self.most);
        if wanted <= self.capacity {
            return Ok(());
        }
        let (rays, hits) = ((wanted * size_of::<Ray>()) as u64, wanted as u64 * self.query.answer_size());
        // Two lists of ray numbers, where there is a second pass to leave rays to.
        let lists = if self.passes.len() > 1 { wanted as u64 * 8 } else { 0 };
        let slot = || {
            let params = context.buffer("params", size_of::<Params>() as u64, Usage::UNIFORM | Usage::COPY_DST);
            let rays = context.buffer("rays", rays, Usage::STORAGE | Usage::COPY_DST);
            let readback = context.buffer("readback", hits + TAIL, Usage::MAP_READ | Usage::COPY_DST);
            let hits = context.buffer("hits", hits, Usage::STORAGE | Usage::COPY_SRC);
            let usage = Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST;
            let list = context.buffer("list", size_of_val(&HEAD) as u64 + lists, usage);
            let groups = context.buffer("groups", INDIRECT, Usage::INDIRECT | Usage::COPY_DST);
            let buffers = [&params, &rays, &hits, &list].into_iter().chain(&scene.buffers);
            let bindings = context.bind(&self.layout, buffers);
            Slot { params, rays, hits, list, groups, readback, clock: context.clock(), bindings }
        };
        self.slots = context.making(|| Ok((0..SLOTS).map(|_| slot()).collect()))?;
        self.capacity = wanted;
        Ok(())
    }

    /// Answers all rays; `take` is given each chunk's first ray, its answers' bytes, and how many rays the first pass left open;
    /// in order. Returned are the nanoseconds that kernels ran, 0 where the device has no clock.
    pub(crate) fn run(
        &mut self,
        context: &Context,
        scene: &OnDevice,
        rays: &[Ray],
        mut take: impl FnMut(usize, &[u8], u32),
    ) -> Result<u64, Error> {
        self.reserve(context, scene, rays.len())?;
        let mut flights = std::collections::VecDeque::with_capacity(SLOTS);
        let (mut at, mut slot) = (0, 0);
        let mut last_done = Instant::now();
        let mut nanoseconds = 0;
        while at < rays.len() || !flights.is_empty() {
            if at < rays.len() && flights.len() < SLOTS {
                let count = self.chunk.min(self.capacity).min(rays.len() - at);
                let chunk = &rays[at..at + count];
                flights.push_back(context.making(|| self.launch(context, scene, slot, at, chunk))?);
                at += count;
                slot = (slot + 1) % SLOTS;
                continue;
            }
            let Some(flight) = flights.pop_front() else { break };
            nanoseconds += self.land(context, &flight, &mut take)?;
            self.adapt(flight.count, last_done.elapsed());
            last_done = Instant::now();
        }
        Ok(nanoseconds)
    }

    fn launch(
        &self,
        context: &Context,
        scene: &OnDevice,
        slot: usize,
        at: usize,
        rays: &[Ray],
    ) -> Result<Flight, Error> {
        let Slot { params, rays: buffer, hits, list, readback, clock, .. } = &self.slots[slot];
        let ray_count = u32::try_from(rays.len()).expect("no more than LARGEST_CHUNK");
        let groups = ray_count.div_ceil(WORKGROUP);
        let row = groups.min(self.widest);
        let given = Params { ray_count, row, scene_exponent: scene.scale_exponent, scene_size: scene.size };
        let queue = &context.handles.queue;
        queue.write_buffer(params, 0, bytemuck::bytes_of(&given));
        queue.write_buffer(buffer, 0, bytemuck::cast_slice(rays));
        queue.write_buffer(list, 0, bytemuck::bytes_of(&HEAD));
        let mut encoder = context.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.encode(&mut encoder, &self.slots[slot], [row, groups.div_ceil(row.max(1))]);
        let bytes = rays.len() as u64 * self.query.answer_size();
        encoder.copy_buffer_to_buffer(hits, 0, readback, 0, bytes);
        encoder.copy_buffer_to_buffer(list, 0, readback, bytes, COUNTERS);
        if let Some((queries, ticks)) = clock {
            encoder.resolve_query_set(queries, 0..2, ticks, 0);
            encoder.copy_buffer_to_buffer(ticks, 0, readback, bytes + COUNTERS, TICKS);
        }
        let submission = queue.submit([encoder.finish()]);
        let (sender, mapped) = mpsc::channel();
        readback.map_async(wgpu::MapMode::Read, 0..bytes + TAIL, move |result| {
            // The receiver is gone only when the batch was given up.
            let _ = sender.send(result);
        });
        Ok(Flight { slot, at, count: rays.len(), submission, mapped })
    }

    /// Each pass after the one before: over all rays, in so many workgroups, or over the list that was left to it.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder, slot: &Slot, [row, rows]: [u32; 2]) {
        let last = self.passes.len() - 1;
        for (i, (pipeline, part)) in self.passes.iter().enumerate() {
            let from = match part.list() {
                None => None,
                Some(Listed::Opened) => Some(COUNTERS),
                Some(Listed::Unrounded) => Some(COUNTERS + INDIRECT),
            };
            if let Some(from) = from {
                encoder.copy_buffer_to_buffer(&slot.list, from, &slot.groups, 0, INDIRECT);
            }
            // wgpu wants one reading at least.
            let clock = slot.clock.as_ref().filter(|_| i == 0 || i == last);
            let timestamp_writes = clock.map(|(query_set, _)| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: (i == 0).then_some(0),
                end_of_pass_write_index: (i == last).then_some(1),
            });
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes });
            pass.set_bind_group(0, &slot.bindings, &[]);
            pass.set_pipeline(pipeline);
            match from {
                Some(_) => pass.dispatch_workgroups_indirect(&slot.groups, 0),
                None => pass.dispatch_workgroups(row, rows, 1),
            }
        }
    }

    /// Hands over a chunk's answers; returned are the nanoseconds that its kernels ran.
    fn land(&self, context: &Context, flight: &Flight, take: &mut impl FnMut(usize, &[u8], u32)) -> Result<u64, Error> {
        context.wait(flight.submission.clone())?;
        let unread =
            |e: &dyn std::error::Error| Error::Driver { what: format!("hits cannot be read back: {}", causes(e)) };
        flight.mapped.recv().map_err(|e| unread(&e))?.map_err(|e| unread(&e))?;
        let Slot { readback, clock, .. } = &self.slots[flight.slot];
        let bytes = flight.count as u64 * self.query.answer_size();
        let [start, end] = context.read(readback, bytes + TAIL, |view| {
            let (answers, tail) = view.split_at(usize::try_from(bytes).expect("they lie in memory"));
            take(flight.at, answers, bytemuck::pod_read_unaligned(&tail[..4]));
            bytemuck::pod_read_unaligned::<[u64; 2]>(&tail[8..24])
        })?;
        readback.unmap();
        Ok(clock.as_ref().map_or(0, |_| context.nanoseconds(end.saturating_sub(start))))
    }

    /// Doubles or halves the chunk towards [`CHUNK_TIME`].
    fn adapt(&mut self, count: usize, took: Duration) {
        let chunk = self.chunk;
        if took > 2 * CHUNK_TIME && count == chunk {
            self.chunk = (chunk / 2).max(WORKGROUP as usize);
        } else if took < CHUNK_TIME / 2 && count == chunk {
            self.chunk = (chunk * 2).min(self.most);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::mem::offset_of;

    use rayproof_scene::{Kind, Precision};

    use super::*;

    /// Names and offsets of a struct's members in a kernel, and its size.
    fn reflect(module: &naga::Module, name: &str) -> (Vec<(String, u32)>, u32) {
        let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).expect("is in the kernel");
        let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name} is no struct") };
        (members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect(), *span)
    }

    fn ours(members: &[(&str, usize)]) -> Vec<(String, u32)> {
        members.iter().map(|&(name, at)| (name.to_owned(), u32::try_from(at).expect("small"))).collect()
    }

    #[test]
    fn layouts_are_those_of_the_kernels() {
        let lists = "const STACK_SIZE: u32 = 32u;
            fn node_quad(i: u32) -> vec4<u32> { return vec4<u32>(i); }
            fn triangle_quad(i: u32) -> vec4<u32> { return vec4<u32>(i); }";
        let kernel = Kernel {
            pass: Pass::Trace(Precision::Fast),
            query: Query::Closest,
            kinds: [Kind::Triangle].into_iter().collect(),
            walk: Walk::Tree,
        };
        let (module, _) = kernel.link(lists).validate().expect("valid");
        let params = ours(&[
            ("ray_count", offset_of!(Params, ray_count)),
            ("row", offset_of!(Params, row)),
            ("scene_exponent", offset_of!(Params, scene_exponent)),
            ("scene_size", offset_of!(Params, scene_size)),
        ]);
        assert_eq!(reflect(&module, "Params"), (params, 16));
        assert_eq!(size_of::<Params>(), 16);
        let ray = ours(&[
            ("origin", offset_of!(Ray, origin)),
            ("t_min", offset_of!(Ray, t_min)),
            ("direction", offset_of!(Ray, direction)),
            ("t_max", offset_of!(Ray, t_max)),
        ]);
        assert_eq!(reflect(&module, "Ray"), (ray, 32));
        assert_eq!(size_of::<Ray>(), 32);
        let entry = &module.entry_points[0];
        assert_eq!((entry.name.as_str(), entry.workgroup_size), (kernel.entry(), [WORKGROUP, 1, 1]));
    }
}
