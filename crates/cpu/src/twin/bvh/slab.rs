//! Twin of `shaders/bvh/slab.wgsl`.

use glam::{Vec3, Vec3A, Vec4};
use rayproof_scene::MISS;
use rayproof_tree::Node;

use crate::branch::Branch;
use crate::twin::batch::Params;
use crate::twin::exact::number::Number as _;
use crate::twin::math::{exponent_of, largest, power_of_two, select};

const SMALLEST_DIRECTION: f32 = power_of_two(-62);
pub(crate) const FARTHEST: f32 = power_of_two(127);
pub(crate) const NARROW: f32 = 1.0 - 16.0 * power_of_two(-23);
pub(crate) const WIDEN: f32 = 1.0 + 16.0 * power_of_two(-23);

/// A node with its planes decoded, four children abreast: decoding is exact, so doing it once changes no bit. An empty
/// slot's box is inside out: entered at infinity, left at minus infinity.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct UnpackedNode {
    /// Low x, high x, low y, high y, low z, high z; the children's words as bits; and nothing, so that three bits index.
    planes: [Vec4; 8],
}

impl Branch for UnpackedNode {
    type Packed = Node;
    const WIDTH: usize = 4;

    fn unpacked(node: &Node) -> Self {
        let boxes = [0, 1, 2, 3].map(|k| match node.children[k] {
            MISS => [Vec3::INFINITY, Vec3::NEG_INFINITY],
            _ => node.child_box(k),
        });
        let planes = |side: usize, axis: usize| Vec4::from(boxes.map(|b| b[side][axis]));
        Self {
            planes: [
                planes(0, 0),
                planes(1, 0),
                planes(0, 1),
                planes(1, 1),
                planes(0, 2),
                planes(1, 2),
                Vec4::from_array(node.children.map(f32::from_bits)),
                Vec4::ZERO,
            ],
        }
    }

    #[inline(always)]
    fn child(&self, k: usize) -> u32 {
        self.planes[6].as_ref()[k & 3].to_bits()
    }

    #[inline(always)]
    fn child_box(&self, k: usize) -> [[f32; 3]; 2] {
        [0, 1].map(|side| [0, 1, 2].map(|axis| self.planes[2 * axis + side][k]))
    }

    fn set_child(&mut self, k: usize, word: u32) {
        self.planes[6][k] = f32::from_bits(word);
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    /// What the planes that the ray meets first on each axis are measured from, and those it meets last.
    pub(crate) from_near: Vec3A,
    pub(crate) from_far: Vec3A,
    /// Which of [`UnpackedNode::planes`] are met first; the other of a pair is met last. The kernel's `back`.
    pub(crate) near: [usize; 3],
    pub(crate) inverse: Vec3A,
    pub(crate) s_min: f32,
    pub(crate) slack: f32,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitDirection {
    pub(crate) direction: Vec3A,
    pub(crate) exponent: i32,
}

#[inline(always)]
pub(crate) fn unit_direction(direction: Vec3) -> UnitDirection {
    let mut d = Vec3A::from(direction);
    let mut exponent = 0;
    if largest(d) < power_of_two(-100) {
        d *= power_of_two(100);
        exponent = -100;
    }
    let shift = exponent_of(largest(d)) - 1;
    UnitDirection { direction: d * power_of_two(-shift), exponent: exponent + shift }
}

#[inline(always)]
pub(crate) fn box_ray(params: &Params, origin: Vec3A, direction: Vec3A, s_min: f32) -> BoxRay {
    let limit = Vec3A::splat(power_of_two(126));
    let o = origin.max(-limit).min(limit);
    let reach = largest(o) + params.scene_size;
    let still = direction.abs().cmplt(Vec3A::splat(SMALLEST_DIRECTION));
    let moved = select(direction, Vec3A::splat(SMALLEST_DIRECTION), still);
    let slack = Vec3A::splat(reach * power_of_two(-50)).max(o.abs() * power_of_two(-22));
    let from_low = select(o, o + slack, still);
    let from_high = select(o, o - slack, still);
    let back = moved.cmplt(Vec3A::ZERO);
    BoxRay {
        from_near: select(from_low, from_high, back),
        from_far: select(from_high, from_low, back),
        near: {
            let back = back.bitmask() as usize;
            [back & 1, 2 + (back >> 1 & 1), 4 + (back >> 2 & 1)]
        },
        inverse: Vec3A::ONE / moved,
        s_min,
        slack: params.scene_size * power_of_two(-40),
    }
}

#[inline(always)]
pub(crate) fn child_keys(ray: &BoxRay, node: &UnpackedNode, s_max: f32) -> Keys {
    let enter = |axis: usize| (node.planes[ray.near[axis] & 7] - ray.from_near[axis]) * ray.inverse[axis];
    let leave = |axis: usize| (node.planes[(ray.near[axis] ^ 1) & 7] - ray.from_far[axis]) * ray.inverse[axis];
    let (enter, leave) = (enter(0).max(enter(1)).max(enter(2)), leave(0).min(leave(1)).min(leave(2)));
    let (narrow, widen) = (Vec4::splat(NARROW), Vec4::splat(WIDEN));
    let near = enter * Vec4::pick(widen, narrow, enter.cmpgt(Vec4::ZERO)) - ray.slack;
    let far = leave * Vec4::pick(narrow, widen, leave.cmpgt(Vec4::ZERO)) + ray.slack;
    let met = near.cmple(far) & near.cmple(Vec4::splat(s_max)) & far.cmpge(Vec4::splat(ray.s_min));
    let mut slot = 0;
    let keys = near.to_array().map(|x| {
        let key = f32::from_bits((x.to_bits() & !3) | slot);
        slot += 1;
        key
    });
    Keys { met: met.bitmask(), keys }
}

/// The children that a ray meets: bit `k` of `met`, and the key of each. The kernel's NOT_HIT
/// is a bit that is not set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keys {
    pub(crate) met: u32,
    pub(crate) keys: [f32; 4],
}

#[cfg(test)]
mod tests;
