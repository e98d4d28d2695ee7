//! Several rays in turns in one thread: while one waits for memory, the others go on. Rays that jump about in a large tree gain most;
//! those that lie beside each other, whose nodes are near already, lose to the turning.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::time::Instant;

use rayproof_scene::{Kind, Ray};
use rayproof_tree::LEAF;

use super::isa::Isa;
use super::node::{EightRay, child_keys};
use super::spot::OnTheSpot;
use super::walk::{DONE, Walked, descend, pop};
use crate::primitives::Primitives;
use crate::twin::bvh::slab::{FARTHEST, UnitDirection, box_ray, unit_direction};
use crate::twin::bvh::traverse::{Found as _, Stack, box_reach};
use crate::twin::exact::leaf::TakeLeaf as _;
use crate::twin::exact::ray::{FirstRay, prepared_ray};

/// How many take turns. Two or four gain nothing, more do not fit the nearest cache.
pub(super) const LANES: usize = 8;

/// A ray on its way.
#[derive(Clone, Copy)]
pub(super) struct Lane<'a, I: Isa, const ANY: bool> {
    /// The ray's place in its block.
    pub(super) index: usize,
    pub(super) first: FirstRay,
    pub(super) unit: UnitDirection,
    pub(super) found: OnTheSpot<'a, ANY>,
    /// Which stack is its own.
    pub(super) stack: usize,
    boxes: EightRay<I>,
    s_max: f32,
    current: u32,
    top: usize,
}

impl<'a, I: Isa, const ANY: bool> Lane<'a, I, ANY> {
    /// A ray at the root; none where it is not for the first stage.
    #[inline(always)]
    pub(super) fn start(isa: I, tree: &Walked<'a>, index: usize, ray: &'a Ray, stack: usize) -> Option<Self> {
        let unit = unit_direction(ray.direction);
        let first = prepared_ray(tree.params, ray, &unit);
        if !first.ordinary {
            return None;
        }
        let o = first.line.origin;
        let boxes = box_ray(tree.params, glam::Vec3A::new(o.x, o.y, o.z), unit.direction, first.t_min);
        let found = OnTheSpot::<ANY>::start(tree.primitives, ray, unit.exponent, &first);
        let (boxes, s_max) = (EightRay::new(isa, &boxes), box_reach(&found, 0));
        Some(Self { index, first, unit, found, stack, boxes, s_max, current: 0, top: 0 })
    }

    /// Goes to one node or one leaf, and brings the next nearer; whether the ray is done.
    #[inline(always)]
    pub(super) fn step(&mut self, isa: I, tree: &Walked<'_>, stack: &mut Stack, kind: impl Fn(u32) -> Kind) -> bool {
        if self.top == 0 {
            stack[0] = (-FARTHEST, DONE);
            self.top = 1;
        }
        if self.current < LEAF {
            let node = &tree.nodes[self.current as usize];
            let met = child_keys(isa, &self.boxes, node, self.s_max);
            self.current = descend(isa, tree, node, met, stack, &mut self.top, self.s_max);
        } else {
            let word = self.current;
            let Primitives { leaves, spheres, .. } = tree.primitives;
            self.found = self.found.take_leaf(kind(word), leaves, spheres, &self.first, word);
            if self.found.finished() {
                return true;
            }
            self.s_max = box_reach(&self.found, 0);
            self.current = pop(stack, &mut self.top, self.s_max);
        }
        tree.prefetch_next(isa, self.current);
        self.current == DONE
    }
}

/// Whether rays go one at a time or in turns: as is faster, by the clock. It changes no answer.
#[derive(Debug, Default)]
pub(super) struct Pace {
    tasks: AtomicU32,
    /// Nanoseconds of a task one at a time, and in turns; 0 where that is not known yet.
    took: [AtomicU32; 2],
}

/// After so many tasks both are tried again.
const ASKED_AGAIN: u32 = 32;

/// How a task goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    pub(super) in_turns: bool,
    /// Where it is a trial.
    started: Option<Instant>,
}

impl Pace {
    /// How the next task goes.
    pub(super) fn choose(&self) -> Chosen {
        let number = self.tasks.fetch_add(1, Relaxed) % ASKED_AGAIN;
        let [one, turns] = [0, 1].map(|way| self.took[way].load(Relaxed));
        let in_turns = match number {
            0 => false,
            1 => true,
            _ => turns != 0 && turns < one,
        };
        Chosen { in_turns, started: (number < 2).then(Instant::now) }
    }

    /// After the task.
    pub(super) fn done(&self, chosen: Chosen) {
        if let Some(started) = chosen.started {
            let nanoseconds = u32::try_from(started.elapsed().as_nanos()).unwrap_or(u32::MAX);
            self.took[usize::from(chosen.in_turns)].store(nanoseconds.max(1), Relaxed);
        }
    }
}
