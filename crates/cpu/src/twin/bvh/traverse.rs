//! Twin of `shaders/bvh/traverse.wgsl`.

use glam::Vec3A;
use rayproof_tree::LEAF;

use super::slab::{BoxRay, FARTHEST, Keys, UnitDirection, UnpackedNode, box_ray, child_keys};
use crate::branch::Branch as _;
use crate::twin::batch::Params;
use crate::twin::math::scale_by_power;

const DONE: u32 = u32::MAX;

/// Entries a traversal has kept for later: the key of a child and its word.
pub(crate) type Stack = Vec<(f32, u32)>;

/// A stack for a tree that needs up to `depth` entries.
pub(crate) fn stack(depth: usize) -> Stack {
    vec![(0.0, 0); depth + 4]
}

/// What a walk needs of a precision's ray.
pub(crate) trait PreparedRay {
    fn origin(&self) -> Vec3A;
    fn t_min(&self) -> f32;
    /// Box units: `s = t 2^box_exponent`.
    fn box_exponent(&self) -> i32;
}

/// What a walk has found so far.
pub(crate) trait Found: Copy {
    /// Beyond this `t` nothing more is of interest.
    fn reach(&self) -> f32;
    /// Whether nothing more is of interest at all.
    fn finished(&self) -> bool;
}

/// Walks the tree with one ray; `intersect_leaf` is the precision's.
#[inline(always)]
pub(crate) fn traverse<R: PreparedRay, F: Found>(
    params: &Params,
    nodes: &[UnpackedNode],
    stack: &mut Stack,
    unit: &UnitDirection,
    ray: &R,
    start: F,
    intersect_leaf: impl Fn(&R, u32, F) -> F,
) -> F {
    let n = ray.box_exponent();
    let boxes = box_ray(params, ray.origin(), unit.direction, scale_by_power(ray.t_min(), n));
    let mut found = start;
    let mut s_max = box_reach(&found, n);

    stack[0] = (-FARTHEST, DONE);
    let mut top = 1;
    let mut current = 0;
    loop {
        while current < LEAF {
            current = descend(&boxes, &nodes[current as usize], s_max, stack, &mut top);
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

/// What has been found, in box units: never below the key of the walk's last entry, or the walk would not end there.
#[inline(always)]
pub(crate) fn box_reach<F: Found>(found: &F, n: i32) -> f32 {
    scale_by_power(found.reach(), n).clamp(-FARTHEST, FARTHEST)
}

/// The nearest child that is met, the others kept; where none is, the next entry kept.
///
/// The kernel sorts four keys by a network; keys differ, so inserting those that are met gives the same order.
#[inline(always)]
fn descend(boxes: &BoxRay, node: &UnpackedNode, s_max: f32, stack: &mut Stack, top: &mut usize) -> u32 {
    let Keys { mut met, keys } = child_keys(boxes, node, s_max);
    let base = *top;
    while met != 0 {
        let k = met.trailing_zeros() as usize;
        met &= met - 1;
        let entry = (keys[k], node.child(k));
        let mut at = *top;
        while at > base && stack[at - 1].0 < entry.0 {
            stack[at] = stack[at - 1];
            at -= 1;
        }
        stack[at] = entry;
        *top += 1;
    }
    if *top == base {
        return pop(stack, top, s_max);
    }
    *top -= 1;
    stack[*top].1
}

#[inline(always)]
fn pop(stack: &Stack, top: &mut usize, s_max: f32) -> u32 {
    loop {
        *top -= 1;
        let (key, word) = stack[*top];
        if key <= s_max {
            return word;
        }
    }
}
