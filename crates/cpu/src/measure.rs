//! What only measuring asks for: walks without a tree, and what single precision takes for crossings, which kernels do not ask.

use rayproof_scene::{Kind, Precision, Ray};
use rayproof_tree::LEAF;

use crate::Engine;
use crate::branch::Branch as _;
use crate::engine::{Path, by_formulas};
use crate::formulas::{Classic, Double, Fast, Formulas, Pair, Textbook};
use crate::primitives::Primitives;
use crate::twin::bvh::slab::unit_direction;
use crate::twin::bvh::traverse::{Found, Stack};
use crate::twin::leaf::single::SingleRay;
use crate::twin::leaf::word::{leaf_first, leaf_range};

impl Engine {
    /// This engine without its tree: every ray is tested with every primitive. It tells what the formulas cost by themselves.
    #[must_use]
    pub fn without_tree(self) -> Self {
        let words = self.nodes.iter().flat_map(|node| node.slots().map(|k| node.child(k))).filter(|&word| word >= LEAF);
        Self { every: Some(words.collect()), ..self }
    }

    /// How many primitives claim that the ray hits them in range, by the formulas of the precision; those of `fast` in the precision
    /// `exact`. On a closed mesh an even number from inside is a leak or a double hit.
    ///
    /// # Panics
    /// When `rays` and `claims` differ in length.
    pub fn claims(&self, rays: &[Ray], claims: &mut [u32]) {
        by_formulas!(self.precision, F => self.claims_by::<F>(rays, claims));
    }

    fn claims_by<F: Formulas>(&self, rays: &[Ray], claims: &mut [u32]) {
        let Primitives { leaves, spheres, .. } = &*self.primitives;
        let count = |ray: &Ray, stack: &mut Stack, _: &mut Path| {
            let unit = unit_direction(ray.direction);
            let ray = F::ray(&self.params, ray, &unit);
            let leaf = |kind, ray: &SingleRay, word, found| match kind {
                Kind::Triangle => Claims::count(found, F::triangles(ray, &leaves[leaf_first(word)]).hits),
                Kind::Sphere => {
                    let hit = |i: usize| u32::from(F::sphere(ray, &spheres[i]).hit);
                    leaf_range(word).fold(found, |found, i| Claims::count(found, hit(i)))
                }
            };
            self.walk(stack, &unit, &ray, Claims::start(&ray), leaf).claims
        };
        self.batch(rays, claims, 0, count, |_, claims, _| claims);
    }
}

/// How many primitives claim a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Claims {
    pub(crate) claims: u32,
    reach: f32,
}

impl Claims {
    pub(crate) fn start(ray: &SingleRay) -> Self {
        Self { claims: 0, reach: ray.t_max }
    }

    /// With those of `hits`, a bit each.
    pub(crate) fn count(self, hits: u32) -> Self {
        Self { claims: self.claims + hits.count_ones(), ..self }
    }
}

impl Found for Claims {
    fn reach(&self) -> f32 {
        self.reach
    }
    fn finished(&self) -> bool {
        false
    }
}
