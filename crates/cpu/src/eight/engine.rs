//! Batches of rays through the tree of eight.

use std::sync::Arc;

use rayon::prelude::*;
use rayproof_scene::{FlatHit, Kind, MISS, Ray, Scene, Undecided};
#[cfg(feature = "measure")]
use rayproof_tree::LEAF;
use rayproof_tree::{Bvh, Scaling, TooLarge};

#[cfg(target_arch = "x86_64")]
use super::isa::Avx2;
use super::isa::{Isa, Plain};
use super::node::EightNode;
use super::spot::OnTheSpot;
use super::turns::{LANES, Lane, Pace};
use super::walk::{Walked, traverse};
#[cfg(feature = "measure")]
use crate::branch::Branch as _;
use crate::engine::{BLOCK, Path, task};
use crate::exact::second::{self, SecondNearest, SecondRay};
use crate::primitives::Primitives;
use crate::twin::batch::Params;
use crate::twin::bvh::every;
use crate::twin::bvh::slab::{UnitDirection, unit_direction};
use crate::twin::bvh::traverse::{Found, PreparedRay, Stack, stack};
use crate::twin::exact::leaf::TakeLeaf;
use crate::twin::exact::leaf::crossings::Crossings;
use crate::twin::exact::leaf::nearest::Nearest;
use crate::twin::exact::ray::{FirstRay, prepared_ray};
use crate::twin::leaf::word::leaf_kind;

/// A scene ready for the precision `exact`, on all cores.
#[derive(Clone, Debug)]
pub struct Exact {
    nodes: Arc<Vec<EightNode>>,
    primitives: Arc<Primitives>,
    stack_depth: usize,
    params: Params,
    /// Whether wider instructions are left alone, as on a processor that has none.
    #[cfg_attr(not(target_arch = "x86_64"), expect(dead_code, reason = "there is nothing else"))]
    plain: bool,
    /// Whether rays go in turns; none where the clock decides.
    turns: Option<bool>,
    /// The words of all leaves, where each is visited by every ray.
    every: Option<Vec<u32>>,
}

/// What is asked of rays.
trait Question: Sync {
    type Found: Copy + Send;
    type Answer: Send;
    const NOTHING: Self::Found;
    fn find<I: Isa>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> Self::Found;
    /// What is found of a block, its rays in turns; whether that can be asked so.
    fn find_in_turns<I: Isa>(&self, _: I, _: &[Ray], _: &mut [Self::Found], _: &mut [Stack], _: &mut [Path]) -> bool {
        false
    }
    fn finish(&self, ray: &Ray, found: Self::Found, path: &mut Path) -> Self::Answer;
}

impl Exact {
    /// Builds the tree over a scene.
    ///
    /// # Errors
    /// When the scene has more primitives than a tree can number.
    pub fn new(scene: &Scene) -> Result<Self, TooLarge> {
        let bvh = Bvh::eight(scene, Scaling::PowerOfTwo)?;
        let (stack_depth, params) = (bvh.stack_depth, Params::new(&bvh));
        let (primitives, nodes) = Primitives::new(bvh);
        Ok(Self {
            nodes: nodes.into(),
            primitives: primitives.into(),
            stack_depth,
            params,
            plain: false,
            turns: None,
            every: None,
        })
    }

    /// This engine with what every processor has: the bits are the same.
    #[must_use]
    pub fn with_plain_instructions(self) -> Self {
        Self { plain: true, ..self }
    }

    /// This engine with its rays in turns, or one at a time, whatever is faster: the bits are the same.
    #[must_use]
    pub fn with_turns(self, turns: bool) -> Self {
        Self { turns: Some(turns), ..self }
    }

    /// This engine without its tree: every ray is tested with every primitive. It tells what the tests cost by themselves.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn without_tree(self) -> Self {
        let words = self.nodes.iter().flat_map(|node| node.slots().map(|k| node.child(k))).filter(|&word| word >= LEAF);
        Self { every: Some(words.collect()), ..self }
    }

    /// The closest hit of each ray, in the rays' order; returned is how many rays the stages left open on their way.
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
        self.batch(rays, hits, &AskClosest(self, make))
    }

    /// Whether each ray hits anything: 1 or 0.
    ///
    /// # Panics
    /// When `rays` and `hits` differ in length.
    pub fn any(&self, rays: &[Ray], hits: &mut [u8]) -> Undecided {
        self.batch(rays, hits, &AskAny(self))
    }

    /// How often each ray crosses the surface: through a shared edge or vertex of a closed mesh once; at a tangent of a sphere twice.
    ///
    /// # Panics
    /// When `rays` and `counts` differ in length.
    pub fn count(&self, rays: &[Ray], counts: &mut [u32]) -> Undecided {
        self.batch(rays, counts, &AskCount(self))
    }

    /// Which stage of the cascade decides the closest hit of each ray: 1 in `f32`, 2 in `f64`, 3 exactly.
    ///
    /// # Panics
    /// When `rays` and `stages` differ in length.
    pub fn deciding_stages(&self, rays: &[Ray], stages: &mut [u8]) {
        self.batch(rays, stages, &AskStages(self));
    }

    fn batch<Q: Question>(&self, rays: &[Ray], answers: &mut [Q::Answer], question: &Q) -> Undecided {
        #[cfg(target_arch = "x86_64")]
        if let (false, Some(avx2)) = (self.plain, Avx2::new()) {
            return self.batch_by(avx2, rays, answers, question);
        }
        self.batch_by(Plain, rays, answers, question)
    }

    /// Answers every ray, a block at a time: what is found is then made answers of, which is independent work, so that the processor
    /// overlaps it.
    fn batch_by<I: Isa, Q: Question>(
        &self,
        isa: I,
        rays: &[Ray],
        answers: &mut [Q::Answer],
        question: &Q,
    ) -> Undecided {
        assert_eq!(rays.len(), answers.len(), "one answer a ray");
        let task = task(rays.len());
        let tasks = rays.par_chunks(task).zip(answers.par_chunks_mut(task));
        let pace = Pace::default();
        tasks
            .map_init(
                // Eight are kept at a time before the nearest is taken.
                || [(); LANES].map(|()| stack(self.stack_depth + 8)),
                |stacks, (rays, answers)| {
                    let mut undecided = Undecided::default();
                    let chosen = pace.choose();
                    // Without a tree nothing is waited for.
                    let in_turns = self.every.is_none() && self.turns.unwrap_or(chosen.in_turns);
                    isa.run(
                        // What is not inlined here is compiled without the instructions.
                        #[inline(always)]
                        || {
                            for (rays, answers) in rays.chunks(BLOCK).zip(answers.chunks_mut(BLOCK)) {
                                let mut paths = [Path::default(); BLOCK];
                                let mut found = [Q::NOTHING; BLOCK];
                                if !(in_turns && question.find_in_turns(isa, rays, &mut found, stacks, &mut paths)) {
                                    for ((ray, found), path) in rays.iter().zip(&mut found).zip(&mut paths) {
                                        *found = question.find(isa, ray, &mut stacks[0], path);
                                    }
                                }
                                for (((ray, answer), found), path) in
                                    rays.iter().zip(answers).zip(found).zip(&mut paths)
                                {
                                    *answer = question.finish(ray, found, path);
                                    undecided += path.tally();
                                }
                            }
                        },
                    );
                    pace.done(chosen);
                    undecided
                },
            )
            .sum()
    }

    /// The walk over the leaves, for a scene of one kind by code that knows of no other.
    #[inline(always)]
    fn walk<I: Isa, R: PreparedRay, F: Found>(
        &self,
        isa: I,
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
        let tree = Walked { params, nodes, primitives };
        match primitives.kinds.only() {
            Some(Kind::Triangle) => traverse(
                isa,
                &tree,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(Kind::Triangle, ray, word, found),
            ),
            Some(Kind::Sphere) => traverse(
                isa,
                &tree,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(Kind::Sphere, ray, word, found),
            ),
            None => traverse(
                isa,
                &tree,
                stack,
                unit,
                ray,
                start,
                #[inline(always)]
                |ray: &R, word, found| leaf(leaf_kind(word), ray, word, found),
            ),
        }
    }

    /// What the first stage finds.
    #[inline(always)]
    fn first<I: Isa, F: Found + TakeLeaf>(
        &self,
        isa: I,
        stack: &mut Stack,
        unit: &UnitDirection,
        ray: &FirstRay,
        start: F,
    ) -> F {
        let Primitives { leaves, spheres, .. } = &*self.primitives;
        self.walk(
            isa,
            stack,
            unit,
            ray,
            start,
            #[inline(always)]
            |kind, ray: &_, word, found| found.take_leaf(kind, leaves, spheres, ray, word),
        )
    }

    /// The place of the primitive that is hit first.
    #[inline(always)]
    fn slot<I: Isa, const ANY: bool>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        let unit = unit_direction(ray.direction);
        let first = prepared_ray(&self.params, ray, &unit);
        if !first.ordinary {
            return self.second_slot::<ANY>(ray, path);
        }
        let start = OnTheSpot::<ANY>::start(&self.primitives, ray, unit.exponent, &first);
        let found = self.first(isa, stack, &unit, &first, start);
        path.open = found.needed();
        if found.nearest.decided() {
            return found.nearest.slot;
        }
        self.narrow_slot(isa, ray, &unit, &first, &found.nearest, stack, path)
    }

    /// The closest hit of a ray that the first stage left open: only between the two ends that it found.
    #[expect(clippy::too_many_arguments, reason = "what the first stage had and found")]
    fn narrow_slot<I: Isa, const ANY: bool>(
        &self,
        isa: I,
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
        let found = self.walk(isa, stack, unit, &narrow, start, leaf);
        path.doubts += found.doubts;
        found.slot()
    }

    /// The closest hit of a ray that is not for the first stage.
    fn second_slot<const ANY: bool>(&self, ray: &Ray, path: &mut Path) -> u32 {
        path.open = true;
        second::slot::<ANY>(&self.nodes, &self.primitives, self.params.chords, ray, &mut path.doubts)
    }

    /// The places of the primitives that rays hit first, the rays in turns.
    #[inline(always)]
    fn slots_in_turns<I: Isa, const ANY: bool>(
        &self,
        isa: I,
        rays: &[Ray],
        stacks: &mut [Stack],
        paths: &mut [Path],
        slots: &mut [u32],
    ) {
        match self.primitives.kinds.only() {
            Some(Kind::Triangle) => self.turns_by::<I, ANY>(isa, rays, stacks, paths, slots, |_| Kind::Triangle),
            Some(Kind::Sphere) => self.turns_by::<I, ANY>(isa, rays, stacks, paths, slots, |_| Kind::Sphere),
            None => self.turns_by::<I, ANY>(isa, rays, stacks, paths, slots, leaf_kind),
        }
    }

    #[inline(always)]
    fn turns_by<I: Isa, const ANY: bool>(
        &self,
        isa: I,
        rays: &[Ray],
        stacks: &mut [Stack],
        paths: &mut [Path],
        slots: &mut [u32],
        kind: impl Fn(u32) -> Kind + Copy,
    ) {
        let tree = Walked { params: &self.params, nodes: &self.nodes, primitives: &self.primitives };
        let mut next = 0;
        let mut lanes: [Option<Lane<'_, I, ANY>>; LANES] = [None; LANES];
        let mut left = 0;
        for (stack, lane) in lanes.iter_mut().enumerate() {
            *lane = self.next_lane(isa, &tree, rays, stack, &mut next, paths, slots);
            left += usize::from(lane.is_some());
        }
        while left > 0 {
            for place in &mut lanes {
                let Some(lane) = place else { continue };
                if !lane.step(isa, &tree, &mut stacks[lane.stack], kind) {
                    continue;
                }
                let (index, stack) = (lane.index, lane.stack);
                paths[index].open = lane.found.needed();
                slots[index] = if lane.found.nearest.decided() {
                    lane.found.nearest.slot
                } else {
                    let Lane { unit, first, found, .. } = &*lane;
                    self.narrow_slot(
                        isa,
                        &rays[index],
                        unit,
                        first,
                        &found.nearest,
                        &mut stacks[stack],
                        &mut paths[index],
                    )
                };
                *place = self.next_lane(isa, &tree, rays, stack, &mut next, paths, slots);
                left -= usize::from(place.is_none());
            }
        }
    }

    /// The next ray that is for the first stage; those before it are answered.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "all that a block has")]
    fn next_lane<'a, I: Isa, const ANY: bool>(
        &self,
        isa: I,
        tree: &Walked<'a>,
        rays: &'a [Ray],
        stack: usize,
        next: &mut usize,
        paths: &mut [Path],
        slots: &mut [u32],
    ) -> Option<Lane<'a, I, ANY>> {
        while let Some(ray) = rays.get(*next) {
            let index = *next;
            *next += 1;
            let lane = Lane::start(isa, tree, index, ray, stack);
            if lane.is_some() {
                return lane;
            }
            slots[index] = self.second_slot::<ANY>(ray, &mut paths[index]);
        }
        None
    }
}

struct AskClosest<'a, M>(&'a Exact, M);

impl<A: Send, M: Fn(FlatHit) -> A + Sync> Question for AskClosest<'_, M> {
    type Found = u32;
    type Answer = A;
    const NOTHING: u32 = MISS;
    #[inline(always)]
    fn find<I: Isa>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        self.0.slot::<I, false>(isa, ray, stack, path)
    }
    #[inline(always)]
    fn find_in_turns<I: Isa>(
        &self,
        isa: I,
        rays: &[Ray],
        found: &mut [u32],
        stacks: &mut [Stack],
        paths: &mut [Path],
    ) -> bool {
        self.0.slots_in_turns::<I, false>(isa, rays, stacks, paths, found);
        true
    }
    #[inline(always)]
    fn finish(&self, ray: &Ray, slot: u32, path: &mut Path) -> A {
        (self.1)(if slot == MISS { FlatHit::MISS } else { self.0.primitives.hit(ray, slot, &mut path.doubts) })
    }
}

struct AskAny<'a>(&'a Exact);

impl Question for AskAny<'_> {
    type Found = u32;
    type Answer = u8;
    const NOTHING: u32 = MISS;
    #[inline(always)]
    fn find<I: Isa>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        self.0.slot::<I, true>(isa, ray, stack, path)
    }
    #[inline(always)]
    fn find_in_turns<I: Isa>(
        &self,
        isa: I,
        rays: &[Ray],
        found: &mut [u32],
        stacks: &mut [Stack],
        paths: &mut [Path],
    ) -> bool {
        self.0.slots_in_turns::<I, true>(isa, rays, stacks, paths, found);
        true
    }
    #[inline(always)]
    fn finish(&self, _: &Ray, slot: u32, _: &mut Path) -> u8 {
        u8::from(slot != MISS)
    }
}

struct AskCount<'a>(&'a Exact);

impl Question for AskCount<'_> {
    type Found = u32;
    type Answer = u32;
    const NOTHING: u32 = 0;
    #[inline(always)]
    fn find<I: Isa>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u32 {
        let Exact { primitives, params, nodes, .. } = self.0;
        let unit = unit_direction(ray.direction);
        let first = prepared_ray(params, ray, &unit);
        if first.ordinary {
            let found = self.0.first(isa, stack, &unit, &first, Crossings::start(&first));
            if !found.open {
                return found.count;
            }
        }
        path.open = true;
        let ray = SecondRay::new(ray, primitives.scale, params.chords);
        second::count(nodes, primitives, &ray, &mut path.doubts)
    }
    #[inline(always)]
    fn finish(&self, _: &Ray, count: u32, _: &mut Path) -> u32 {
        count
    }
}

struct AskStages<'a>(&'a Exact);

impl Question for AskStages<'_> {
    type Found = u8;
    type Answer = u8;
    const NOTHING: u8 = 0;
    fn find<I: Isa>(&self, isa: I, ray: &Ray, stack: &mut Stack, path: &mut Path) -> u8 {
        let slot = self.0.slot::<I, false>(isa, ray, stack, path);
        if slot != MISS {
            self.0.primitives.hit(ray, slot, &mut path.doubts);
        }
        if path.doubts > 0 { 3 } else { 1 + u8::from(path.open) }
    }
    fn finish(&self, _: &Ray, stage: u8, _: &mut Path) -> u8 {
        stage
    }
}
