//! Twin of `shaders/leaf/single.wgsl`: what the precisions in `f32` make of a leaf.

use rayproof_scene::{FlatHit, MISS};

use crate::twin::bvh::traverse::{Found, PreparedRay};
use crate::twin::math::{scale_by_power, without_sign};

/// One primitive's answer: whether it is hit in range, and where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) hit: bool,
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
}

pub(crate) const NO_HIT: Candidate = Candidate { hit: false, t: 0.0, u: 0.0, v: 0.0 };

/// A ray as the formulas of the precisions in `f32` take it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SingleRay {
    pub(crate) origin: glam::Vec3A,
    pub(crate) direction: glam::Vec3A,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// Box units: `s = t 2^box_exponent`.
    pub(crate) box_exponent: i32,
    /// What is returned: `t 2^out_exponent`.
    pub(crate) out_exponent: i32,
}

impl PreparedRay for SingleRay {
    #[inline(always)]
    fn origin(&self) -> glam::Vec3A {
        self.origin
    }
    #[inline(always)]
    fn t_min(&self) -> f32 {
        self.t_min
    }
    #[inline(always)]
    fn box_exponent(&self) -> i32 {
        self.box_exponent
    }
}

/// The closest hit so far, or the first found where `ANY`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest<const ANY: bool>(pub(crate) FlatHit);

impl<const ANY: bool> Closest<ANY> {
    #[inline(always)]
    pub(crate) fn start(ray: &SingleRay) -> Self {
        Self(FlatHit { t: ray.t_max, u: 0.0, v: 0.0, primitive: MISS })
    }

    /// The hit as it is returned.
    #[inline(always)]
    pub(crate) fn hit(self, ray: &SingleRay) -> FlatHit {
        let FlatHit { t, u, v, primitive } = self.0;
        if primitive == MISS {
            return FlatHit::MISS;
        }
        let t = scale_by_power(without_sign(t), ray.out_exponent);
        FlatHit { t: without_sign(t), u: without_sign(u), v: without_sign(v), primitive }
    }
}

impl<const ANY: bool> Found for Closest<ANY> {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.0.t
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        ANY && self.0.primitive != MISS
    }
}

/// The closer of two: the smaller `t`, and among equal `t` the lower number.
#[inline(always)]
pub(crate) fn closer(found: Candidate, id: u32, hit: FlatHit) -> FlatHit {
    if found.hit && (found.t < hit.t || (found.t == hit.t && id < hit.primitive)) {
        return FlatHit { t: found.t, u: found.u, v: found.v, primitive: id };
    }
    hit
}
