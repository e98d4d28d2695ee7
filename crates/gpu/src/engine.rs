//! A scene's tree on a device.

use std::fmt::Write as _;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Arc, Mutex};

use bytemuck::Pod;
use rayproof_scene::{FlatHit, Kinds, Precision, Ray};
use rayproof_tree::Bvh;

use crate::Error;
use crate::batch::Stream;
use crate::context::Context;
use crate::gpu::{Gpu, NO_BOUND};
use crate::kernel::{Pass, Query, Walk, Width};
use crate::kinds::{self, List};
use crate::pages::{Pages, check_bindings};
use crate::second_stage::SecondStage;

/// In the place of an answer: left open. `OPEN` in `shaders/exact/list.wgsl`.
const OPEN: u32 = 0xffff_fffe;

/// A tree on a device, ready to answer.
pub struct Engine {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) scene: OnDevice,
    /// What answers each query, one pass after the other.
    passes: Passes,
    /// Each query's kernels and buffers, made when first asked for; one batch at a time. The last is the first pass alone.
    streams: [Mutex<Option<Stream>>; 4],
    pub(crate) kernel_nanoseconds: AtomicU64,
}

/// What a batch left open.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Open {
    /// How many rays the first stage did not decide.
    pub after_first: u64,
    /// The numbers of the rays that have no answer: exact arithmetic has to give it. In no other precision there are any.
    pub rays: Vec<usize>,
}

/// The passes of a precision.
enum Passes {
    Single(Precision),
    Exact { first: Width, second: Width, rest: Option<Width> },
}

impl Passes {
    fn of(&self, query: Query) -> Vec<Pass> {
        match *self {
            Self::Single(precision) => vec![Pass::Trace(precision)],
            Self::Exact { first, second, rest } => {
                let mut passes = vec![Pass::First(first), Pass::Second(second)];
                if query == Query::Closest {
                    passes.push(Pass::Round(second));
                    passes.extend(rest.map(Pass::RoundRest));
                }
                passes
            }
        }
    }
}

/// The scene's lists, as every kernel of this scene binds them.
pub(crate) struct OnDevice {
    pub(crate) kinds: Kinds,
    /// WGSL: the accessors of the lists and the size of the stack.
    pub(crate) accessors: String,
    pub(crate) buffers: Vec<wgpu::Buffer>,
    /// How many nodes the tree has.
    pub(crate) nodes: usize,
    pub(crate) scale_exponent: i32,
    pub(crate) size: f32,
    pub(crate) walk: Walk,
}

impl Engine {
    /// Puts a tree, scaled for `precision`, on a device.
    ///
    /// # Errors
    /// When the device cannot hold it or fails; [`Error::Unsupported`] where the precision does not [suit](Gpu::refuses) device and
    /// scene.
    pub fn new(gpu: Arc<Gpu>, bvh: &Bvh, precision: Precision) -> Result<Self, Error> {
        if let Some(why) = gpu.refuses(precision, bvh)? {
            return Err(refused(&gpu, precision, why));
        }
        if precision != Precision::Exact {
            return Self::with_passes(gpu, bvh, Passes::Single(precision));
        }
        let second = gpu.second_stage()?.ok_or_else(|| refused(&gpu, precision, NO_BOUND))?;
        let first = if gpu.fingerprint().rounds_to_nearest() { Width::Single } else { Width::SingleByRule };
        Self::exact(gpu, bvh, first, second)
    }

    /// The precision `exact` with these numbers.
    pub(crate) fn exact(gpu: Arc<Gpu>, bvh: &Bvh, first: Width, second: SecondStage) -> Result<Self, Error> {
        Self::with_passes(gpu, bvh, Passes::Exact { first, second: second.width, rest: second.rest })
    }

    fn with_passes(gpu: Arc<Gpu>, bvh: &Bvh, passes: Passes) -> Result<Self, Error> {
        let scene = gpu.context.making(|| OnDevice::new(&gpu.context, bvh))?;
        Ok(Self { gpu, scene, passes, streams: Default::default(), kernel_nanoseconds: AtomicU64::new(0) })
    }

    /// The closest hit of each ray, in the rays' order. Rays that are returned as open have no answer yet.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Open, Error> {
        self.closest_as(rays, hits, |hit| hit)
    }

    /// As [`closest`](Self::closest), each hit as `make` writes it.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest_as<A>(&self, rays: &[Ray], hits: &mut [A], make: impl Fn(FlatHit) -> A) -> Result<Open, Error> {
        // An open ray has no primitive that a scene knows.
        let known = |hit: FlatHit| if hit.primitive == OPEN { FlatHit::MISS } else { hit };
        self.answer(Query::Closest, rays, hits, |hit: &FlatHit| (make(known(*hit)), hit.primitive))
    }

    /// Whether each ray hits anything: 1 or 0. Rays that are returned as open have no answer yet.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Result<Open, Error> {
        self.answer(Query::Any, rays, hits, |&word: &u32| (u8::from(word == 1), word))
    }

    /// How often each ray crosses the surface; for the precision `exact`. Rays that are returned as open have no answer yet.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length, or the precision is another.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Result<Open, Error> {
        assert!(matches!(self.passes, Passes::Exact { .. }), "only the precision exact counts");
        self.answer(Query::Count, rays, counts, |&word: &u32| (word, word))
    }

    /// Which rays the first stage of `exact` leaves open.
    ///
    /// # Errors
    /// When the device fails.
    ///
    /// # Panics
    /// When the precision is another.
    pub fn open_after_first(&self, rays: &[Ray]) -> Result<Open, Error> {
        let Passes::Exact { first, .. } = self.passes else { panic!("only the precision exact has a first stage") };
        let mut hits = vec![FlatHit::MISS; rays.len()];
        let take = |hit: &FlatHit| (*hit, hit.primitive);
        self.run(&self.streams[3], Query::Closest, &[Pass::First(first)], rays, &mut hits, take)
    }

    fn answer<W: Pod, A>(
        &self,
        query: Query,
        rays: &[Ray],
        answers: &mut [A],
        take: impl Fn(&W) -> (A, u32),
    ) -> Result<Open, Error> {
        self.run(&self.streams[query as usize], query, &self.passes.of(query), rays, answers, take)
    }

    /// Streams rays through passes; `take` makes an answer of what a kernel wrote, and tells the word that may say [`OPEN`].
    fn run<W: Pod, A>(
        &self,
        slot: &Mutex<Option<Stream>>,
        query: Query,
        passes: &[Pass],
        rays: &[Ray],
        answers: &mut [A],
        take: impl Fn(&W) -> (A, u32),
    ) -> Result<Open, Error> {
        assert_eq!(rays.len(), answers.len(), "one answer a ray");
        // What a batch that fails or panics leaves in flight is not known: a new stream takes its place.
        let mut slot = slot.lock().unwrap_or_else(|panicked| {
            let mut slot = panicked.into_inner();
            *slot = None;
            slot
        });
        let stream = match &mut *slot {
            Some(stream) => stream,
            empty => empty.insert(Stream::new(&self.gpu, &self.scene, query, passes)?),
        };
        let mut open = Open::default();
        let ran = stream.run(&self.gpu.context, &self.scene, rays, |at, bytes, after_first| {
            open.after_first += u64::from(after_first);
            for ((i, answer), word) in answers.iter_mut().enumerate().skip(at).zip(bytemuck::cast_slice::<u8, W>(bytes))
            {
                let (found, state) = take(word);
                *answer = found;
                if state == OPEN {
                    open.rays.push(i);
                }
            }
        });
        if ran.is_err() {
            *slot = None;
        }
        self.kernel_nanoseconds.fetch_add(ran?, Relaxed);
        Ok(open)
    }
}

pub(crate) fn refused(gpu: &Gpu, precision: Precision, why: &str) -> Error {
    Error::Unsupported { what: format!("the precision {} does not run on {}: {why}", precision.name(), gpu.name()) }
}

impl OnDevice {
    fn new(context: &Context, bvh: &Bvh) -> Result<Self, Error> {
        let kinds = bvh.kinds();
        let nodes =
            List { name: "node_quad", element: "vec4<u32>", stride: 16, bytes: bytemuck::cast_slice(&bvh.nodes) };
        let lists = std::iter::once(nodes).chain(kinds.iter().flat_map(|kind| kinds::lists(kind, bvh)));
        // Three more than the tree needs: a push writes before it knows whether the entry stays; and the last entry. In
        // steps, so that scenes share kernels.
        let stack = (bvh.stack_depth + 4).next_multiple_of(32);
        let mut accessors = format!("const STACK_SIZE: u32 = {stack}u;\n");
        let mut buffers = Vec::new();
        for List { name, element, stride, bytes } in lists {
            let pages = Pages::upload(context, name, bytes, stride);
            let _ = write!(accessors, "{}", pages.accessor(name, element, 4 + buffers.len()));
            buffers.extend(pages.buffers);
        }
        check_bindings(context, buffers.len() + 3)?;
        let (scale_exponent, size, nodes) = (bvh.scale_exponent, bvh.size, bvh.nodes.len());
        Ok(Self { kinds, accessors, buffers, nodes, scale_exponent, size, walk: Walk::Tree })
    }
}
