//! A scene's tree on a device.

use std::fmt::Write as _;
use std::sync::{Arc, Mutex};

use rayproof_scene::bvh::{Bvh, Tier};
use rayproof_scene::{Hit, Ray};

use crate::Error;
use crate::batch::Stream;
use crate::gpu::Gpu;
use crate::kernel::{Contents, Kernel, Query};
use crate::pages::{Pages, check_bindings};

/// A tree on a device, ready to answer.
pub struct Engine {
    gpu: Arc<Gpu>,
    scene: OnDevice,
    tier: Tier,
    /// Each query's kernel and buffers, made when first asked for; one batch at a time.
    streams: [Mutex<Option<Stream>>; 2],
}

/// The scene's lists, as every kernel of this scene binds them.
pub(crate) struct OnDevice {
    pub(crate) contents: Contents,
    /// WGSL: the accessors of the lists and the size of the stack.
    pub(crate) accessors: String,
    pub(crate) buffers: Vec<wgpu::Buffer>,
    pub(crate) scale_exponent: i32,
    pub(crate) size: f32,
}

impl Engine {
    /// Puts a tree, scaled for `tier`, on a device.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub fn new(gpu: Arc<Gpu>, bvh: &Bvh, tier: Tier) -> Result<Self, Error> {
        let scene = OnDevice::new(&gpu, bvh)?;
        gpu.check()?;
        Ok(Self { gpu, scene, tier, streams: Default::default() })
    }

    /// The closest hit of each ray, in the rays' order.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) -> Result<(), Error> {
        assert_eq!(rays.len(), hits.len(), "one answer a ray");
        self.run(Query::Closest, rays, |at, bytes| {
            let part = &mut hits[at..at + bytes.len() / 16];
            bytemuck::cast_slice_mut(part).copy_from_slice(bytes);
        })
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Result<(), Error> {
        assert_eq!(rays.len(), hits.len(), "one answer a ray");
        self.run(Query::Any, rays, |at, bytes| {
            for (slot, word) in hits[at..].iter_mut().zip(bytes.chunks_exact(4)) {
                *slot = word[0];
            }
        })
    }

    fn run(&self, query: Query, rays: &[Ray], take: impl FnMut(usize, &[u8])) -> Result<(), Error> {
        let mut slot =
            self.streams[query as usize].lock().map_err(|_| Error::Device("an earlier batch panicked".to_owned()))?;
        let stream = match &mut *slot {
            Some(stream) => stream,
            empty => {
                let kernel = Kernel { tier: self.tier, query, contents: self.scene.contents };
                empty.insert(Stream::new(&self.gpu, &self.scene, kernel)?)
            }
        };
        stream.run(&self.gpu, &self.scene, rays, take)
    }
}

impl OnDevice {
    fn new(gpu: &Gpu, bvh: &Bvh) -> Result<Self, Error> {
        let contents = match (bvh.triangles.is_empty(), bvh.spheres.is_empty()) {
            (_, true) => Contents::Triangles,
            (true, false) => Contents::Spheres,
            (false, false) => Contents::Both,
        };
        let mut lists: Vec<(&str, &str, &[u8], usize)> =
            vec![("node_quad", "vec4<u32>", bytemuck::cast_slice(&bvh.nodes), 16)];
        if contents.triangles() {
            lists.push(("triangle_quad", "vec4<u32>", bytemuck::cast_slice(&bvh.triangles), 16));
        }
        if contents.spheres() {
            lists.push(("sphere_quad", "vec4<u32>", bytemuck::cast_slice(&bvh.spheres), 16));
            lists.push(("sphere_id", "u32", bytemuck::cast_slice(&bvh.sphere_ids), 4));
        }
        // Three more than the tree needs: a push writes before it knows whether the entry stays; and the last entry. In
        // steps, so that scenes share kernels.
        let stack = (bvh.stack_depth + 4).next_multiple_of(32);
        let mut accessors = format!("const STACK_SIZE: u32 = {stack}u;\n");
        let mut buffers = Vec::new();
        for (name, element, bytes, stride) in lists {
            let pages = Pages::upload(gpu, name, bytes, stride);
            let _ = write!(accessors, "{}", pages.accessor(name, element, 3 + buffers.len()));
            buffers.extend(pages.buffers);
        }
        check_bindings(gpu, buffers.len() + 2)?;
        Ok(Self { contents, accessors, buffers, scale_exponent: bvh.scale_exponent, size: bvh.size })
    }
}
