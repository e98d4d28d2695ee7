//! Twin of `shaders/fast/ray.wgsl`.

use rayproof_scene::Ray;

use crate::twin::batch::Params;
use crate::twin::bvh::slab::UnitDirection;
use crate::twin::leaf::single::SingleRay;
use crate::twin::math::{scale_high_end, scale_low_end, scale_point};

#[inline(always)]
pub(crate) fn prepared_ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> SingleRay {
    let m = params.scene_exponent;
    let n = unit.exponent + m;
    let origin = scale_point(ray.origin.into(), m);
    SingleRay {
        origin,
        direction: unit.direction,
        t_min: scale_low_end(ray.t_min, n),
        t_max: scale_high_end(ray.t_max, n),
        box_exponent: 0,
        out_exponent: -n,
    }
}
