//! Twin of `shaders/bvh/traverse.wgsl`.

use rayproof_scene::{Hit, MISS, Ray};

use super::slab::{BoxRay, FARTHEST, NOT_HIT, UnitDirection, WideNode, box_ray, child_keys, sorted, unit_direction};
use crate::batch::{Params, TierRay};
use crate::math::scale_by_power;

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
    hit.t = scale_by_power(hit.t, ray.out_exponent);
    hit
}

/// The nearest child that is met, the others kept; where none is, the next entry kept.
#[inline(always)]
fn descend(boxes: &BoxRay, node: &WideNode, s_max: f32, stack: &mut Stack, top: &mut usize) -> u32 {
    let order = sorted(child_keys(boxes, node, s_max));
    let child = |key: f32| node.children[(key.to_bits() & 3) as usize];
    if order[0] >= NOT_HIT {
        return pop(stack, top, s_max);
    }
    for key in [order[3], order[2], order[1]] {
        stack[*top] = (key, child(key));
        *top += usize::from(key < NOT_HIT);
    }
    child(order[0])
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
