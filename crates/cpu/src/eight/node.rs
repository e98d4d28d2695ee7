//! A ray against the eight boxes of a node. The arithmetic, its roundings and the pad that covers them are those of
//! `shaders/bvh/slab.wgsl`; only that keys carry no slot, which rounds less.

use glam::Vec3A;
use rayproof_tree::{EMPTY, EightBoxes};

use super::isa::{Eight, Isa};
use crate::branch::Branch;
use crate::twin::bvh::slab::{BoxRay, NARROW, WIDEN};

/// Eight children: 224 bytes, in four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct EightNode {
    /// Low x, high x, low y, high y, low z, high z. An empty slot's box is inside out: entered at infinity, left at minus infinity.
    planes: [Eight; 6],
    children: [u32; 8],
}

impl Branch for EightNode {
    type Packed = EightBoxes;
    const WIDTH: usize = 8;

    fn unpacked(node: &EightBoxes) -> Self {
        let plane = |axis: usize, side: usize| {
            let nothing = [f32::INFINITY, f32::NEG_INFINITY][side];
            let of = |k: usize| if node.children[k] == EMPTY { nothing } else { node.boxes[k][side][axis] };
            Eight(std::array::from_fn(of))
        };
        let planes = [plane(0, 0), plane(0, 1), plane(1, 0), plane(1, 1), plane(2, 0), plane(2, 1)];
        Self { planes, children: node.children }
    }

    #[inline(always)]
    fn child(&self, k: usize) -> u32 {
        self.children[k & 7]
    }

    fn set_child(&mut self, k: usize, word: u32) {
        self.children[k] = word;
    }

    fn child_box(&self, k: usize) -> [[f32; 3]; 2] {
        [0, 1].map(|side| [0, 1, 2].map(|axis| self.planes[2 * axis + side].0[k]))
    }
}

/// A ray as boxes are tested with, eight times.
#[derive(Clone, Copy, Debug)]
pub(super) struct EightRay<I: Isa> {
    from_near: [I::V; 3],
    from_far: [I::V; 3],
    inverse: [I::V; 3],
    /// Which of [`EightNode::planes`] are met first; the other of a pair is met last.
    near: [usize; 3],
    s_min: I::V,
    slack: I::V,
    narrow: I::V,
    widen: I::V,
}

#[inline(always)]
fn three<I: Isa>(isa: I, p: Vec3A) -> [I::V; 3] {
    [isa.splat(p.x), isa.splat(p.y), isa.splat(p.z)]
}

impl<I: Isa> EightRay<I> {
    #[inline(always)]
    pub(super) fn new(isa: I, ray: &BoxRay) -> Self {
        Self {
            from_near: three(isa, ray.from_near),
            from_far: three(isa, ray.from_far),
            inverse: three(isa, ray.inverse),
            near: ray.near,
            s_min: isa.splat(ray.s_min),
            slack: isa.splat(ray.slack),
            narrow: isa.splat(NARROW),
            widen: isa.splat(WIDEN),
        }
    }
}

/// Where the planes of an axis that the ray meets first are met.
#[inline(always)]
fn enter<I: Isa>(isa: I, ray: &EightRay<I>, node: &EightNode, axis: usize) -> I::V {
    let plane = isa.load(&node.planes[ray.near[axis].min(5)]);
    isa.mul(isa.sub(plane, ray.from_near[axis]), ray.inverse[axis])
}

#[inline(always)]
fn leave<I: Isa>(isa: I, ray: &EightRay<I>, node: &EightNode, axis: usize) -> I::V {
    let plane = isa.load(&node.planes[(ray.near[axis] ^ 1).min(5)]);
    isa.mul(isa.sub(plane, ray.from_far[axis]), ray.inverse[axis])
}

/// The children that a ray meets, a bit each, and where it enters each at the earliest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) bits: u32,
    pub(super) keys: Eight,
}

/// The children that a ray meets before `s_max`.
#[inline(always)]
pub(super) fn child_keys<I: Isa>(isa: I, ray: &EightRay<I>, node: &EightNode, s_max: f32) -> Met {
    let enter = isa.max(isa.max(enter(isa, ray, node, 0), enter(isa, ray, node, 1)), enter(isa, ray, node, 2));
    let leave = isa.min(isa.min(leave(isa, ray, node, 0), leave(isa, ray, node, 1)), leave(isa, ray, node, 2));
    // Which factor is the earlier one depends on the sign: it is the one that gives less.
    let near = isa.sub(isa.min(isa.mul(enter, ray.narrow), isa.mul(enter, ray.widen)), ray.slack);
    let far = isa.add(isa.max(isa.mul(leave, ray.narrow), isa.mul(leave, ray.widen)), ray.slack);
    let bits = isa.at_most(near, isa.min(far, isa.splat(s_max))) & isa.at_most(ray.s_min, far);
    Met { bits, keys: isa.store(near) }
}
