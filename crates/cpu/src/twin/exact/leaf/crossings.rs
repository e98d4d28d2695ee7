//! Twin of `shaders/exact/leaf/crossings.wgsl`.

use super::Take;
use super::candidate::Candidate;
use crate::twin::bvh::traverse::Found;
use crate::twin::exact::ray::FirstRay;

/// How many certain crossings there are so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    pub(crate) count: u32,
    /// Whether one was not certain.
    pub(crate) open: bool,
    t_max: f32,
}

impl Crossings {
    #[inline(always)]
    pub(crate) fn start(ray: &FirstRay) -> Self {
        Self { count: 0, open: false, t_max: ray.t_max }
    }
}

impl Found for Crossings {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.t_max
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        self.open
    }
}

impl Take for Crossings {
    #[inline(always)]
    fn take(self, ray: &FirstRay, candidate: Candidate<f32>, _: u32) -> Self {
        if candidate.is_outside(ray.t_min, ray.t_max) {
            return self;
        }
        if candidate.is_inside(ray.t_min, ray.t_max) {
            return Self { count: self.count + 1, ..self };
        }
        Self { open: true, ..self }
    }
}
