//! Twin of `shaders/classic/ray.wgsl`.

use rayproof_scene::Ray;

use crate::twin::batch::Params;
use crate::twin::bvh::slab::UnitDirection;
use crate::twin::leaf::single::SingleRay;
use crate::twin::math::{scale_high_end, scale_low_end, scale_point};

#[inline(always)]
pub(crate) fn prepared_ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> SingleRay {
    let n = params.scene_exponent;
    let origin = scale_point(ray.origin.into(), n);
    SingleRay {
        origin,
        direction: ray.direction.into(),
        t_min: scale_low_end(ray.t_min, n),
        t_max: scale_high_end(ray.t_max, n),
        box_exponent: unit.exponent,
        out_exponent: -n,
    }
}
