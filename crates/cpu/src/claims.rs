//! What single precision takes for hits, all of them: the kernels have no such question.

use crate::twin::bvh::traverse::Found;
use crate::twin::leaf::single::SingleRay;

/// How many primitives claim a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Claims {
    pub(crate) claims: u32,
    reach: f32,
}

impl Claims {
    pub(crate) fn start(ray: &SingleRay) -> Self {
        Self { claims: 0, reach: ray.t_max }
    }

    /// With those of `hits`, a bit each.
    pub(crate) fn count(self, hits: u32) -> Self {
        Self { claims: self.claims + hits.count_ones(), ..self }
    }
}

impl Found for Claims {
    fn reach(&self) -> f32 {
        self.reach
    }
    fn finished(&self) -> bool {
        false
    }
}
