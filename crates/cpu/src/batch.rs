//! Twin of `shaders/batch.wgsl`.

use rayproof_scene::bvh::Bvh;

/// What every ray of a batch shares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Params {
    pub(crate) scene_exponent: i32,
    pub(crate) scene_size: f32,
}

impl Params {
    pub(crate) const fn new(bvh: &Bvh) -> Self {
        Self { scene_exponent: bvh.scale_exponent, scene_size: bvh.size }
    }
}

/// One primitive's answer: whether it is hit in range, and where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) hit: bool,
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
}

pub(crate) const NO_HIT: Candidate = Candidate { hit: false, t: 0.0, u: 0.0, v: 0.0 };

/// A ray as a tier's formulas take it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TierRay {
    pub(crate) origin: glam::Vec3A,
    pub(crate) direction: glam::Vec3A,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// Box units: `s = t 2^box_exponent`.
    pub(crate) box_exponent: i32,
    /// What is returned: `t 2^out_exponent`.
    pub(crate) out_exponent: i32,
}
