use rayon::prelude::*;
use rayproof_scene::bvh::{Bvh, Tier};
use rayproof_scene::{Hit, Ray, Sphere};

use crate::batch::Params;
use crate::bvh::slab::WideNode;
use crate::bvh::traverse::{Stack, stack, traverse};
use crate::lanes::Triangles4;
use crate::leaf::{SPHERES, intersect_spheres, intersect_triangles, lanes};
use crate::{classic, fast, wide};

/// Rays one task takes: enough to hide its start, few enough to share out the last.
const TASK: usize = 4096;

/// A tree ready to be walked, and the tier whose formulas run at its leaves.
#[derive(Clone, Debug)]
pub struct Engine {
    nodes: Vec<WideNode>,
    leaves: Vec<Triangles4>,
    spheres: Vec<Sphere>,
    sphere_ids: Vec<u32>,
    stack_depth: usize,
    params: Params,
    tier: Tier,
}

/// One kernel: the tier's three functions over the leaves the scene has.
macro_rules! kernel {
    ($engine:expr, $ray:expr, $stack:expr, $any:expr, $tier:ident, $leaf:expr) => {
        traverse::<$any>(&$engine.params, &$engine.nodes, $stack, $ray, $tier::tier_ray, $leaf)
    };
}

/// The three kernels of a tier, chosen by what the scene holds.
macro_rules! tier {
    ($engine:expr, $ray:expr, $stack:expr, $any:expr, $tier:ident) => {{
        let triangles =
            |ray: &_, word, hit| intersect_triangles(&$engine.leaves, ray, word, hit, $tier::intersect_triangle);
        let spheres = |ray: &_, word, hit| {
            intersect_spheres(&$engine.spheres, &$engine.sphere_ids, ray, word, hit, $tier::intersect_sphere)
        };
        if $engine.spheres.is_empty() {
            kernel!($engine, $ray, $stack, $any, $tier, triangles)
        } else if $engine.leaves.is_empty() {
            kernel!($engine, $ray, $stack, $any, $tier, spheres)
        } else {
            kernel!($engine, $ray, $stack, $any, $tier, |ray: &_, word, hit| {
                if word & SPHERES == 0 { triangles(ray, word, hit) } else { spheres(ray, word, hit) }
            })
        }
    }};
}

impl Engine {
    /// Makes a tree ready for the formulas of `tier`, for which it was scaled.
    #[must_use]
    pub fn new(bvh: Bvh, tier: Tier) -> Self {
        let (leaves, nodes) = lanes(&bvh);
        let params = Params::new(&bvh);
        // The packed nodes and triangles end here: their decoded form is all that is walked.
        let Bvh { spheres, sphere_ids, stack_depth, .. } = bvh;
        Self { nodes, leaves, spheres, sphere_ids, stack_depth, params, tier }
    }

    /// The closest hit of each ray, in the rays' order.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) {
        self.batch(
            rays,
            hits,
            #[inline(always)]
            |ray, stack| {
                let hit = self.trace::<false>(ray, stack);
                if hit.is_hit() { hit } else { Hit::MISS }
            },
        );
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) {
        self.batch(
            rays,
            hits,
            #[inline(always)]
            |ray, stack| u8::from(self.trace::<true>(ray, stack).is_hit()),
        );
    }

    fn batch<A: Send>(&self, rays: &[Ray], answers: &mut [A], answer: impl Fn(&Ray, &mut Stack) -> A + Sync) {
        assert_eq!(rays.len(), answers.len(), "one answer a ray");
        rays.par_chunks(TASK).zip(answers.par_chunks_mut(TASK)).for_each_init(
            || stack(self.stack_depth),
            |stack, (rays, answers)| {
                wide::run(
                    #[inline(always)]
                    || {
                        for (ray, slot) in rays.iter().zip(answers) {
                            *slot = answer(ray, stack);
                        }
                    },
                );
            },
        );
    }

    #[inline(always)]
    fn trace<const ANY_HIT: bool>(&self, ray: &Ray, stack: &mut Stack) -> Hit {
        match self.tier {
            Tier::Classic => tier!(self, ray, stack, ANY_HIT, classic),
            Tier::Fast => tier!(self, ray, stack, ANY_HIT, fast),
        }
    }
}
