//! Twin of `shaders/bvh/traverse.wgsl`.

use rayproof_scene::{Hit, MISS, Ray};

use super::slab::{BoxRay, FARTHEST, Keys, UnitDirection, WideNode, box_ray, child_keys, unit_direction};
use crate::batch::{Params, TierRay};
use crate::math::{scale_by_power, without_sign};

const LEAF: u32 = 1 << 31;
const DONE: u32 = u32::MAX;

/// Entries a traversal has kept for later: the key of a child and its word.
pub(crate) type Stack = Vec<(f32, u32)>;

/// A stack for a tree that needs up to `depth` entries.
pub(crate) fn stack(depth: usize) -> Stack {
    vec![(0.0, 0); depth + 4]
}

/// Walks the tree with one ray; `tier_ray` and `intersect_leaf` are the tier's.
#[inline(always)]
pub(crate) fn traverse<const ANY_HIT: bool>(
    params: &Params,
    nodes: &[WideNode],
    stack: &mut Stack,
    given: &Ray,
    tier_ray: impl Fn(&Params, &Ray, &UnitDirection) -> TierRay,
    intersect_leaf: impl Fn(&TierRay, u32, Hit) -> Hit,
) -> Hit {
    let unit = unit_direction(given.direction);
    let ray = tier_ray(params, given, &unit);
    let boxes = box_ray(params, ray.origin, unit.direction, scale_by_power(ray.t_min, ray.box_exponent));
    let mut hit = Hit { t: ray.t_max, u: 0.0, v: 0.0, primitive: MISS };
    let mut s_max = scale_by_power(ray.t_max, ray.box_exponent).min(FARTHEST);

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
        hit = intersect_leaf(&ray, current, hit);
        if ANY_HIT && hit.primitive != MISS {
            break;
        }
        s_max = scale_by_power(hit.t, ray.box_exponent).min(FARTHEST);
        current = pop(stack, &mut top, s_max);
    }
    let t = scale_by_power(hit.t, ray.out_exponent);
    Hit { t: without_sign(t), u: without_sign(hit.u), v: without_sign(hit.v), primitive: hit.primitive }
}

/// The nearest child that is met, the others kept; where none is, the next entry kept.
///
/// The kernel sorts four keys by a network; keys differ, so inserting those that are met gives the same order.
#[inline(always)]
fn descend(boxes: &BoxRay, node: &WideNode, s_max: f32, stack: &mut Stack, top: &mut usize) -> u32 {
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
