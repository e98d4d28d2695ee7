//! The walk of one ray through the tree of eight.

use rayproof_scene::Kind;
use rayproof_tree::LEAF;

use super::isa::{Eight, Isa};
use super::node::{EightNode, EightRay, Met, child_keys};
use crate::branch::Branch as _;
use crate::primitives::Primitives;
use crate::twin::batch::Params;
use crate::twin::bvh::slab::{FARTHEST, UnitDirection, box_ray};
use crate::twin::bvh::traverse::{Found, PreparedRay, Stack, box_reach};
use crate::twin::leaf::word::{leaf_first, leaf_kind};
use crate::twin::math::scale_by_power;

pub(super) const DONE: u32 = u32::MAX;

/// The tree, with what brings a leaf nearer before it is needed.
pub(super) struct Walked<'a> {
    pub(super) params: &'a Params,
    pub(super) nodes: &'a [EightNode],
    pub(super) primitives: &'a Primitives,
}

impl Walked<'_> {
    #[inline(always)]
    fn prefetch<I: Isa>(&self, isa: I, word: u32) {
        if word < LEAF {
            return;
        }
        if let (Kind::Triangle, Some(leaf)) = (leaf_kind(word), self.primitives.leaves.get(leaf_first(word))) {
            isa.prefetch(leaf);
        }
    }

    /// Where a ray goes next, of several in turns.
    #[inline(always)]
    pub(super) fn prefetch_next<I: Isa>(&self, isa: I, word: u32) {
        if word < LEAF {
            if let Some(node) = self.nodes.get(word as usize) {
                isa.prefetch(node);
            }
        } else if word != DONE {
            self.prefetch(isa, word);
        }
    }
}

/// Walks the tree with one ray, nearest boxes first; `intersect_leaf` says what has been found after a leaf.
#[inline(always)]
pub(super) fn traverse<I: Isa, R: PreparedRay, F: Found>(
    isa: I,
    tree: &Walked<'_>,
    stack: &mut Stack,
    unit: &UnitDirection,
    ray: &R,
    start: F,
    intersect_leaf: impl Fn(&R, u32, F) -> F,
) -> F {
    let n = ray.box_exponent();
    let boxes = box_ray(tree.params, ray.origin(), unit.direction, scale_by_power(ray.t_min(), n));
    let boxes = EightRay::new(isa, &boxes);
    let mut found = start;
    let mut s_max = box_reach(&found, n);

    stack[0] = (-FARTHEST, DONE);
    let mut top = 1;
    let mut current = 0;
    loop {
        while current < LEAF {
            let node = &tree.nodes[current as usize];
            let met = child_keys(isa, &boxes, node, s_max);
            current = descend(isa, tree, node, met, stack, &mut top, s_max);
        }
        if current == DONE {
            break;
        }
        found = intersect_leaf(ray, current, found);
        if found.finished() {
            break;
        }
        s_max = box_reach(&found, n);
        current = pop(stack, &mut top, s_max);
    }
    found
}

/// The nearest child that is met, the others kept, the farthest below; where none is met, the next entry kept.
#[inline(always)]
pub(super) fn descend<I: Isa>(
    isa: I,
    tree: &Walked<'_>,
    node: &EightNode,
    Met { bits: mut met, keys: Eight(keys) }: Met,
    stack: &mut Stack,
    top: &mut usize,
    s_max: f32,
) -> u32 {
    if met == 0 {
        return pop(stack, top, s_max);
    }
    let first = met.trailing_zeros() as usize;
    met &= met - 1;
    if met == 0 {
        return node.child(first);
    }
    let base = *top;
    let mut nearest = (keys[first & 7], node.child(first));
    while met != 0 {
        let k = met.trailing_zeros() as usize;
        met &= met - 1;
        let mut entry = (keys[k & 7], node.child(k));
        // Among equals the first slot goes first.
        if entry.0 < nearest.0 {
            std::mem::swap(&mut entry, &mut nearest);
        }
        tree.prefetch(isa, entry.1);
        let mut at = *top;
        while at > base && stack[at - 1].0 < entry.0 {
            stack[at] = stack[at - 1];
            at -= 1;
        }
        stack[at] = entry;
        *top += 1;
    }
    nearest.1
}

#[inline(always)]
pub(super) fn pop(stack: &Stack, top: &mut usize, s_max: f32) -> u32 {
    loop {
        *top -= 1;
        let (key, word) = stack[*top];
        if key <= s_max {
            return word;
        }
    }
}
