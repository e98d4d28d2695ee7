//! Twin of `shaders/batch.wgsl`.

use rayproof_scene::{Hit, MISS};
use rayproof_tree::Bvh;

use crate::bvh::traverse::{Found, PreparedRay};
use crate::math::{scale_by_power, without_sign};

/// What every ray of a batch shares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Params {
    pub(crate) scene_exponent: i32,
    pub(crate) scene_size: f32,
    /// Whether the precision `exact` has bounds for this scene in `f32`.
    pub(crate) plain: bool,
    /// Whether the scene holds spheres.
    pub(crate) spheres: bool,
}

impl Params {
    pub(crate) const fn new(bvh: &Bvh) -> Self {
        Self {
            scene_exponent: bvh.scale_exponent,
            scene_size: bvh.size,
            plain: bvh.plain,
            spheres: !bvh.spheres.is_empty(),
        }
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
pub(crate) struct Nearest<const ANY: bool>(pub(crate) Hit);

impl<const ANY: bool> Nearest<ANY> {
    #[inline(always)]
    pub(crate) fn start(ray: &SingleRay) -> Self {
        Self(Hit { t: ray.t_max, u: 0.0, v: 0.0, primitive: MISS })
    }

    /// The hit as it is returned.
    #[inline(always)]
    pub(crate) fn hit(self, ray: &SingleRay) -> Hit {
        let Hit { t, u, v, primitive } = self.0;
        if primitive == MISS {
            return Hit::MISS;
        }
        let t = scale_by_power(t, ray.out_exponent);
        Hit { t: without_sign(t), u: without_sign(u), v: without_sign(v), primitive }
    }
}

impl<const ANY: bool> Found for Nearest<ANY> {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.0.t
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        ANY && self.0.primitive != MISS
    }
}

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
