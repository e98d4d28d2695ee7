use rayon::prelude::*;
use rayproof_scene::bvh::{Bvh, Tier};
use rayproof_scene::{Hit, MISS, Ray, Sphere, Undecided};

use crate::batch::{Candidate, Nearest, Params, SingleRay};
use crate::bvh::slab::{UnitDirection, WideNode, unit_direction};
use crate::bvh::traverse::{Found, Stack, TierRay, stack, traverse};
use crate::exact::{self, Crossings, First, first, second, second::SecondRay};
use crate::lanes::{Candidates, Triangles4};
use crate::leaf::{SPHERES, intersect_spheres, intersect_triangles};
use crate::primitives::Primitives;
use crate::{classic, fast, wide};

/// Rays one task takes: enough to hide its start, few enough to share out the last.
const TASK: usize = 4096;

/// A tree ready to be walked, and the tier whose formulas run at its leaves.
#[derive(Clone, Debug)]
pub struct Engine {
    nodes: Vec<WideNode>,
    primitives: Primitives,
    stack_depth: usize,
    params: Params,
    tier: Tier,
}

/// Which tiers of the cascade a ray went through.
#[derive(Clone, Copy, Debug, Default)]
struct Path {
    /// The first left it open.
    open: bool,
    /// How often only exact arithmetic could tell.
    doubts: u32,
}

impl Path {
    fn tally(self) -> Undecided {
        let exact = u64::from(self.doubts > 0);
        Undecided { first_tier: u64::from(self.open), after_refine: exact, resolved_on_cpu: exact }
    }
}

impl Engine {
    /// Makes a tree ready for the formulas of `tier`, for which it was scaled.
    #[must_use]
    pub fn new(bvh: Bvh, tier: Tier) -> Self {
        let (stack_depth, params) = (bvh.stack_depth, Params::new(&bvh));
        // The packed nodes and triangles end here: their decoded form is all that is walked.
        let (primitives, nodes) = Primitives::new(bvh);
        Self { nodes, primitives, stack_depth, params, tier }
    }

    /// The closest hit of each ray, in the rays' order; returned is how many rays the tier `exact` left open on its way.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn closest(&self, rays: &[Ray], hits: &mut [Hit]) -> Undecided {
        self.batch(
            rays,
            hits,
            #[inline(always)]
            |ray, stack, path| match self.tier {
                Tier::Exact => self.exact_hit(ray, stack, path),
                tier => self.single::<false>(tier, ray, stack),
            },
        )
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Undecided {
        self.batch(
            rays,
            hits,
            #[inline(always)]
            |ray, stack, path| {
                u8::from(match self.tier {
                    Tier::Exact => self.exact_slot::<true>(ray, stack, path).0 != MISS,
                    tier => self.single::<true>(tier, ray, stack).is_hit(),
                })
            },
        )
    }

    /// How often each ray crosses the surface, exactly, whatever the tier: through a shared edge or vertex of a closed mesh
    /// once; at a tangent of a sphere twice.
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Undecided {
        self.batch(
            rays,
            counts,
            #[inline(always)]
            |ray, stack, path| self.exact_count(ray, stack, path),
        )
    }

    /// Which tier of the cascade decides the closest hit of each ray: 1 in `f32`, 2 in `f64`, 3 exactly.
    ///
    /// # Panics
    /// When `rays` and `tiers` differ in length.
    pub fn deciding_tiers(&self, rays: &[Ray], tiers: &mut [u8]) {
        self.batch(rays, tiers, |ray, stack, path| {
            self.exact_hit(ray, stack, path);
            if path.doubts > 0 { 3 } else { 1 + u8::from(path.open) }
        });
    }

    fn batch<A: Send>(
        &self,
        rays: &[Ray],
        answers: &mut [A],
        answer: impl Fn(&Ray, &mut Stack, &mut Path) -> A + Sync,
    ) -> Undecided {
        assert_eq!(rays.len(), answers.len(), "one answer a ray");
        rays.par_chunks(TASK)
            .zip(answers.par_chunks_mut(TASK))
            .map_init(
                || stack(self.stack_depth),
                |stack, (rays, answers)| {
                    let mut undecided = Undecided::default();
                    wide::run(
                        #[inline(always)]
                        || {
                            for (ray, slot) in rays.iter().zip(answers) {
                                let mut path = Path::default();
                                *slot = answer(ray, stack, &mut path);
                                undecided += path.tally();
                            }
                        },
                    );
                    undecided
                },
            )
            .sum()
    }

    /// The hit by the formulas of a tier in single precision.
    #[inline(always)]
    fn single<const ANY: bool>(&self, tier: Tier, ray: &Ray, stack: &mut Stack) -> Hit {
        let unit = unit_direction(ray.direction);
        let params = &self.params;
        if tier == Tier::Classic {
            let ray = classic::tier_ray(params, ray, &unit);
            self.nearest::<ANY>(stack, &unit, &ray, classic::intersect_triangle, classic::intersect_sphere)
        } else {
            let ray = fast::tier_ray(params, ray, &unit);
            self.nearest::<ANY>(stack, &unit, &ray, fast::intersect_triangle, fast::intersect_sphere)
        }
    }

    #[inline(always)]
    fn nearest<const ANY: bool>(
        &self,
        stack: &mut Stack,
        unit: &UnitDirection,
        ray: &SingleRay,
        triangle: impl Fn(&SingleRay, &Triangles4) -> Candidates,
        sphere: impl Fn(&SingleRay, &Sphere) -> Candidate,
    ) -> Hit {
        let Primitives { leaves, spheres, sphere_ids, .. } = &self.primitives;
        let triangles = |ray: &SingleRay, word, found| intersect_triangles(leaves, ray, word, found, &triangle);
        let spheres = |ray: &SingleRay, word, found| intersect_spheres(spheres, sphere_ids, ray, word, found, &sphere);
        self.walk(stack, unit, ray, Nearest::<ANY>::start(ray), triangles, spheres).hit(ray)
    }

    /// The walk over the leaves that the scene has.
    #[inline(always)]
    fn walk<R: TierRay, F: Found>(
        &self,
        stack: &mut Stack,
        unit: &UnitDirection,
        ray: &R,
        start: F,
        triangles: impl Fn(&R, u32, F) -> F,
        spheres: impl Fn(&R, u32, F) -> F,
    ) -> F {
        let Self { nodes, params, primitives, .. } = self;
        if primitives.spheres.is_empty() {
            traverse(params, nodes, stack, unit, ray, start, triangles)
        } else if primitives.leaves.is_empty() {
            traverse(params, nodes, stack, unit, ray, start, spheres)
        } else {
            traverse(
                params,
                nodes,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray, word, found| {
                    if word & SPHERES == 0 { triangles(ray, word, found) } else { spheres(ray, word, found) }
                },
            )
        }
    }

    #[inline(always)]
    fn exact_hit(&self, ray: &Ray, stack: &mut Stack, path: &mut Path) -> Hit {
        let (slot, known) = self.exact_slot::<false>(ray, stack, path);
        if slot == MISS {
            return Hit::MISS;
        }
        let Primitives { scale, scale_exponent, .. } = self.primitives;
        let ray = known.unwrap_or_else(|| SecondRay::new(ray, scale));
        let (shape, id) = (self.primitives.shape(slot), self.primitives.id(slot));
        exact::round(&ray, &shape, id, scale_exponent, &mut path.doubts)
    }

    /// The place of the primitive that is hit first, and the ray in `f64` where it took that.
    #[inline(always)]
    fn exact_slot<const ANY: bool>(&self, ray: &Ray, stack: &mut Stack, path: &mut Path) -> (u32, Option<SecondRay>) {
        let unit = unit_direction(ray.direction);
        let first = exact::first_ray(&self.params, ray, &unit);
        if first.ordinary {
            let Primitives { leaves, spheres, .. } = &self.primitives;
            let triangles = |ray: &_, word, found| first::intersect_triangles(leaves, ray, word, found);
            let spheres = |ray: &_, word, found| first::intersect_spheres(spheres, ray, word, found);
            let found = self.walk(stack, &unit, &first, First::<ANY>::start(&first), triangles, spheres);
            if found.decided() {
                return (found.slot, None);
            }
        }
        path.open = true;
        let ray = SecondRay::new(ray, self.primitives.scale);
        (second::closest::<ANY>(&self.nodes, &self.primitives, &ray, &mut path.doubts), Some(ray))
    }

    #[inline(always)]
    fn exact_count(&self, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        let unit = unit_direction(ray.direction);
        let first = exact::first_ray(&self.params, ray, &unit);
        if first.ordinary {
            let Primitives { leaves, spheres, .. } = &self.primitives;
            let triangles = |ray: &_, word, found| first::count_triangles(leaves, ray, word, found);
            let spheres = |ray: &_, word, found| first::count_spheres(spheres, ray, word, found);
            let found = self.walk(stack, &unit, &first, Crossings::start(&first), triangles, spheres);
            if !found.open {
                return found.count;
            }
        }
        path.open = true;
        let ray = SecondRay::new(ray, self.primitives.scale);
        second::count(&self.nodes, &self.primitives, &ray, &mut path.doubts)
    }
}
