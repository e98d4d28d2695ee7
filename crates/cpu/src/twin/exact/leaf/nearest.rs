//! Twin of `shaders/exact/leaf/nearest.wgsl`.

use rayproof_scene::MISS;

use super::Take;
use super::candidate::Candidate;
use crate::twin::bvh::traverse::Found;
use crate::twin::exact::ray::FirstRay;

/// The certain hit that is closest so far and how near one might be that is not certain. Where `ANY`, the first certain
/// hit ends the walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest<const ANY: bool> {
    /// The exact `t` lies between.
    pub(crate) low: f32,
    pub(crate) high: f32,
    /// The primitive, by its place in the leaves; [`MISS`] for none.
    pub(crate) slot: u32,
    /// No primitive left open is hit before this.
    pub(crate) doubt: f32,
}

impl<const ANY: bool> Nearest<ANY> {
    #[inline(always)]
    pub(crate) fn start(ray: &FirstRay) -> Self {
        Self { low: ray.t_max, high: ray.t_max, slot: MISS, doubt: f32::INFINITY }
    }

    /// Whether the answer is certain.
    #[inline(always)]
    pub(crate) fn decided(&self) -> bool {
        (ANY && self.slot != MISS) || self.high < self.doubt
    }

    /// With a hit that is certain and closer than all so far.
    #[inline(always)]
    pub(crate) fn with(self, candidate: Candidate<f32>, slot: u32) -> Self {
        Self { low: candidate.low, high: candidate.high, slot, doubt: self.doubt }
    }

    /// With one left open that is not hit before `low`.
    #[inline(always)]
    pub(crate) fn doubting(self, low: f32) -> Self {
        Self { doubt: self.doubt.min(low), ..self }
    }

    /// Between which `t` the hit lies, if there is one.
    pub(crate) fn window(&self) -> [f32; 2] {
        [self.low.min(self.doubt), self.high]
    }
}

impl<const ANY: bool> Found for Nearest<ANY> {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.high
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        ANY && self.slot != MISS
    }
}

impl<const ANY: bool> Take for Nearest<ANY> {
    #[inline(always)]
    fn take(self, ray: &FirstRay, candidate: Candidate<f32>, place: u32) -> Self {
        if candidate.is_outside(ray.t_min, self.high) {
            return self;
        }
        if candidate.is_inside(ray.t_min, ray.t_max) && (candidate.high < self.low || self.slot == MISS) {
            return self.with(candidate, place);
        }
        self.doubting(candidate.low)
    }
}
