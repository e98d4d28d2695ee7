mod walks;

use std::sync::Arc;

use rayon::prelude::*;
use rayproof_scene::{FlatHit, MISS, Precision, Ray, Undecided};
use rayproof_tree::{Bvh, Scaling};

use crate::formulas::{Classic, Double, Fast, Formulas, Pair, Textbook};
use crate::primitives::Primitives;
use crate::simd;
use crate::twin::batch::Params;
use crate::twin::bvh::slab::UnpackedNode;
use crate::twin::bvh::traverse::{Stack, stack};

/// Rays one task takes at most: enough to hide its start, few enough to share out the last.
const TASK: usize = 4096;

/// Rays a block: few enough to stay in the nearest cache.
pub(crate) const BLOCK: usize = 64;

/// Rays a task. Few rays may be hard ones: each core gets its share.
pub(crate) fn task(rays: usize) -> usize {
    (rays / (4 * crate::threads())).clamp(BLOCK, TASK)
}

/// A tree ready to be walked, and the precision whose formulas run at its leaves.
#[derive(Clone, Debug)]
pub struct Engine {
    pub(crate) nodes: Arc<[UnpackedNode]>,
    pub(crate) primitives: Arc<Primitives>,
    pub(crate) stack_depth: usize,
    pub(crate) params: Params,
    pub(crate) precision: Precision,
    /// The words of all leaves, where each is visited by every ray.
    pub(crate) every: Option<Vec<u32>>,
}

/// Evaluates a call with `$formulas` standing for the formulas of a precision; those of `fast` for `exact`.
macro_rules! by_formulas {
    ($precision:expr, $formulas:ident => $call:expr) => {
        match $precision {
            Precision::Textbook => by_formulas!(@ $formulas = Textbook; $call),
            Precision::Classic => by_formulas!(@ $formulas = Classic; $call),
            Precision::Fast | Precision::Exact => by_formulas!(@ $formulas = Fast; $call),
            Precision::Pair => by_formulas!(@ $formulas = Pair; $call),
            Precision::Double => by_formulas!(@ $formulas = Double; $call),
        }
    };
    (@ $formulas:ident = $chosen:ty; $call:expr) => {{
        type $formulas = $chosen;
        $call
    }};
}

#[cfg(feature = "measure")]
pub(crate) use by_formulas;

/// Which stages of the cascade a ray went through.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Path {
    /// The first left it open.
    pub(crate) open: bool,
    /// How often only exact arithmetic could tell.
    pub(crate) doubts: u32,
}

impl Path {
    pub(crate) fn tally(self) -> Undecided {
        let exact = u64::from(self.doubts > 0);
        Undecided { first_stage: u64::from(self.open), after_refine: exact, resolved_on_cpu: exact }
    }
}

impl Engine {
    /// Makes a tree ready for the formulas of `precision`, for which it was scaled.
    #[must_use]
    pub fn new(bvh: Bvh, precision: Precision) -> Self {
        let (stack_depth, params) = (bvh.stack_depth, Params::new(&bvh));
        // The packed nodes and triangles end here: their decoded form is all that is walked.
        let (primitives, nodes) = Primitives::new(bvh);
        Self { nodes: nodes.into(), primitives: primitives.into(), stack_depth, params, precision, every: None }
    }

    /// This tree with the formulas of another precision, shared and not copied; `None` where that one scales scenes otherwise.
    #[must_use]
    pub fn with_precision(&self, precision: Precision) -> Option<Self> {
        (Scaling::of(precision) == Scaling::of(self.precision)).then(|| Self { precision, ..self.clone() })
    }

    /// The closest hit of each ray, in the rays' order; returned is how many rays the precision `exact` left open on its way.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Undecided {
        self.closest_as(rays, hits, |hit| hit)
    }

    /// As [`closest`](Self::closest), each hit as `make` writes it.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest_as<A: Send>(&self, rays: &[Ray], hits: &mut [A], make: impl Fn(FlatHit) -> A + Sync) -> Undecided {
        if self.precision != Precision::Exact {
            return by_formulas!(self.precision, F => self.closest_by::<F, A>(rays, hits, make));
        }
        self.batch(
            rays,
            hits,
            MISS,
            #[inline(always)]
            |ray, stack, path| self.exact_slot::<false>(ray, stack, path),
            #[inline(always)]
            |ray, place, path| {
                make(if place == MISS { FlatHit::MISS } else { self.primitives.hit(ray, place, &mut path.doubts) })
            },
        )
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Undecided {
        if self.precision != Precision::Exact {
            return by_formulas!(self.precision, F => self.any_by::<F>(rays, hits));
        }
        self.batch(
            rays,
            hits,
            0,
            #[inline(always)]
            |ray, stack, path| u8::from(self.exact_slot::<true>(ray, stack, path) != MISS),
            |_, hit, _| hit,
        )
    }

    /// How often each ray crosses the surface, exactly, whatever the precision: through a shared edge or vertex of a closed mesh
    /// once; at a tangent of a sphere twice.
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Undecided {
        self.batch(
            rays,
            counts,
            0,
            #[inline(always)]
            |ray, stack, path| self.exact_count(ray, stack, path),
            |_, count, _| count,
        )
    }

    /// Which stage of the cascade decides the closest hit of each ray: 1 in `f32`, 2 in `f64`, 3 exactly.
    ///
    /// # Panics
    /// When `rays` and `stages` differ in length.
    pub fn deciding_stages(&self, rays: &[Ray], stages: &mut [u8]) {
        let decide = |ray: &Ray, stack: &mut Stack, path: &mut Path| {
            let slot = self.exact_slot::<false>(ray, stack, path);
            if slot != MISS {
                self.primitives.hit(ray, slot, &mut path.doubts);
            }
            if path.doubts > 0 { 3 } else { 1 + u8::from(path.open) }
        };
        self.batch(rays, stages, 0, decide, |_, stage, _| stage);
    }

    /// Answers every ray, a block at a time: `find` finds what `finish` then makes answers of, which is independent work, so that
    /// the processor overlaps it.
    pub(crate) fn batch<B: Copy + Sync, A: Send>(
        &self,
        rays: &[Ray],
        answers: &mut [A],
        nothing: B,
        find: impl Fn(&Ray, &mut Stack, &mut Path) -> B + Sync,
        finish: impl Fn(&Ray, B, &mut Path) -> A + Sync,
    ) -> Undecided {
        assert_eq!(rays.len(), answers.len(), "one answer a ray");
        let task = task(rays.len());
        rays.par_chunks(task)
            .zip(answers.par_chunks_mut(task))
            .map_init(
                || stack(self.stack_depth),
                |stack, (rays, answers)| {
                    let mut undecided = Undecided::default();
                    simd::run(
                        #[inline(always)]
                        || {
                            for (rays, answers) in rays.chunks(BLOCK).zip(answers.chunks_mut(BLOCK)) {
                                let mut paths = [Path::default(); BLOCK];
                                let mut found = [nothing; BLOCK];
                                for ((ray, found), path) in rays.iter().zip(&mut found).zip(&mut paths) {
                                    *found = find(ray, stack, path);
                                }
                                for (((ray, answer), found), path) in
                                    rays.iter().zip(answers).zip(found).zip(&mut paths)
                                {
                                    *answer = finish(ray, found, path);
                                    undecided += path.tally();
                                }
                            }
                        },
                    );
                    undecided
                },
            )
            .sum()
    }

    fn closest_by<F: Formulas, A: Send>(
        &self,
        rays: &[Ray],
        hits: &mut [A],
        make: impl Fn(FlatHit) -> A + Sync,
    ) -> Undecided {
        self.batch(
            rays,
            hits,
            FlatHit::MISS,
            #[inline(always)]
            |ray, stack, _| self.nearest::<F, false>(ray, stack),
            #[inline(always)]
            |_, hit, _| make(hit),
        )
    }

    fn any_by<F: Formulas>(&self, rays: &[Ray], hits: &mut [u8]) -> Undecided {
        self.batch(
            rays,
            hits,
            0,
            #[inline(always)]
            |ray, stack, _| u8::from(self.nearest::<F, true>(ray, stack).is_hit()),
            |_, hit, _| hit,
        )
    }
}
