//! The walks of single rays, and what each finds.

use rayproof_scene::{FlatHit, Kind, Ray};

use super::{Engine, Path};
use crate::exact::second::{self, SecondNearest, SecondRay};
use crate::formulas::Formulas;
use crate::primitives::Primitives;
use crate::twin::bvh::every;
use crate::twin::bvh::slab::{UnitDirection, unit_direction};
use crate::twin::bvh::traverse::{Found, PreparedRay, Stack, traverse};
use crate::twin::exact;
use crate::twin::exact::leaf::TakeLeaf as _;
use crate::twin::exact::leaf::crossings::Crossings;
use crate::twin::exact::leaf::nearest::Nearest;
use crate::twin::exact::ray::FirstRay;
use crate::twin::leaf::single::{Closest, SingleRay};
use crate::twin::leaf::spheres::intersect_spheres;
use crate::twin::leaf::triangles::intersect_triangles;
use crate::twin::leaf::word::leaf_kind;

impl Engine {
    /// The hit by the formulas of a precision other than `exact`.
    #[inline(always)]
    pub(super) fn nearest<F: Formulas, const ANY: bool>(&self, ray: &Ray, stack: &mut Stack) -> FlatHit {
        let unit = unit_direction(ray.direction);
        let ray = F::ray(&self.params, ray, &unit);
        let Primitives { leaves, spheres, sphere_ids, .. } = &*self.primitives;
        self.walk(
            stack,
            &unit,
            &ray,
            Closest::<ANY>::start(&ray),
            #[inline(always)]
            |kind, ray: &SingleRay, word, found| match kind {
                Kind::Triangle => intersect_triangles(leaves, ray, word, found, F::triangles),
                Kind::Sphere => intersect_spheres(spheres, sphere_ids, ray, word, found, F::sphere),
            },
        )
        .hit(&ray)
    }

    /// The walk over the leaves, for a scene of one kind by code that knows of no other.
    #[inline(always)]
    pub(crate) fn walk<R: PreparedRay, F: Found>(
        &self,
        stack: &mut Stack,
        unit: &UnitDirection,
        ray: &R,
        start: F,
        leaf: impl Fn(Kind, &R, u32, F) -> F,
    ) -> F {
        let Self { nodes, params, primitives, every, .. } = self;
        if let Some(words) = every {
            return every::traverse(words, ray, start, |ray: &R, word, found| leaf(leaf_kind(word), ray, word, found));
        }
        match primitives.kinds.only() {
            Some(Kind::Triangle) => traverse(
                params,
                nodes,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(Kind::Triangle, ray, word, found),
            ),
            Some(Kind::Sphere) => traverse(
                params,
                nodes,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(Kind::Sphere, ray, word, found),
            ),
            None => traverse(
                params,
                nodes,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(leaf_kind(word), ray, word, found),
            ),
        }
    }

    /// The place of the primitive that is hit first.
    #[inline(always)]
    pub(super) fn exact_slot<const ANY: bool>(&self, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        let unit = unit_direction(ray.direction);
        let first = exact::ray::prepared_ray(&self.params, ray, &unit);
        if !first.ordinary {
            return self.second_slot::<ANY>(ray, path);
        }
        let Primitives { leaves, spheres, .. } = &*self.primitives;
        let found = self.walk(
            stack,
            &unit,
            &first,
            Nearest::<ANY>::start(&first),
            #[inline(always)]
            |kind, ray: &_, word, found| found.take_leaf(kind, leaves, spheres, ray, word),
        );
        if found.decided() {
            return found.slot;
        }
        self.narrow_slot(ray, &unit, &first, &found, stack, path)
    }

    /// The closest hit of a ray that the first stage left open: only between the two ends that it found.
    fn narrow_slot<const ANY: bool>(
        &self,
        ray: &Ray,
        unit: &UnitDirection,
        first: &FirstRay,
        found: &Nearest<ANY>,
        stack: &mut Stack,
        path: &mut Path,
    ) -> u32 {
        path.open = true;
        let [low, high] = found.window();
        let narrow = FirstRay { t_min: first.t_min.max(low), ..*first };
        let start = SecondNearest::<ANY>::start(high, 2.0_f64.powi(unit.exponent));
        let ray = SecondRay::new(ray, self.primitives.scale, self.params.chords);
        let leaf = |_, _: &FirstRay, word, found: SecondNearest<ANY>| found.leaf(&self.primitives, &ray, word);
        let found = self.walk(stack, unit, &narrow, start, leaf);
        path.doubts += found.doubts;
        found.slot()
    }

    /// The closest hit of a ray that is not for the first stage.
    fn second_slot<const ANY: bool>(&self, ray: &Ray, path: &mut Path) -> u32 {
        path.open = true;
        second::slot::<ANY>(&self.nodes, &self.primitives, self.params.chords, ray, &mut path.doubts)
    }

    #[inline(always)]
    pub(super) fn exact_count(&self, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        let unit = unit_direction(ray.direction);
        let first = exact::ray::prepared_ray(&self.params, ray, &unit);
        if first.ordinary {
            let Primitives { leaves, spheres, .. } = &*self.primitives;
            let found = self.walk(
                stack,
                &unit,
                &first,
                Crossings::start(&first),
                #[inline(always)]
                |kind, ray: &_, word, found| found.take_leaf(kind, leaves, spheres, ray, word),
            );
            if !found.open {
                return found.count;
            }
        }
        path.open = true;
        let ray = SecondRay::new(ray, self.primitives.scale, self.params.chords);
        second::count(&self.nodes, &self.primitives, &ray, &mut path.doubts)
    }
}
