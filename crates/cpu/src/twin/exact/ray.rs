//! Twin of `shaders/exact/ray.wgsl`: a ray as the first stage takes it.

use glam::Vec3A;
use rayproof_scene::Ray;

use super::line::Line;
use super::number::single::UNIT;
use super::vector::Vector;
use crate::twin::batch::Params;
use crate::twin::bvh::slab::{FARTHEST, UnitDirection};
use crate::twin::bvh::traverse::PreparedRay;
use crate::twin::math::{largest, power_of_two, scale_by_power, scale_point};

/// Beyond `SMALL` and `LARGE` no bound is proven: such a ray is left to the stage that has no limits.
const SMALL: f32 = power_of_two(-100);
const LARGE: f32 = power_of_two(55);

/// A scaled ray with the parts of the error bounds that depend on it alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstRay {
    pub(crate) line: Line<f32>,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// Whether the bounds hold.
    pub(crate) ordinary: bool,
}

impl PreparedRay for FirstRay {
    #[inline(always)]
    fn origin(&self) -> Vec3A {
        let o = self.line.origin;
        Vec3A::new(o.x, o.y, o.z)
    }
    #[inline(always)]
    fn t_min(&self) -> f32 {
        self.t_min
    }
    #[inline(always)]
    fn box_exponent(&self) -> i32 {
        0
    }
}

/// Whether scaling `given` to `scaled` may have cost a bit: a number that is neither zero nor well above the subnormals.
#[inline(always)]
fn lost(given: Vec3A, scaled: Vec3A) -> bool {
    (given.cmpne(Vec3A::ZERO) & scaled.abs().cmplt(Vec3A::splat(SMALL))).any()
}

/// Whether scaling an end of the range may have cost a bit.
#[inline(always)]
fn lost_end(given: f32, scaled: f32) -> bool {
    given != 0.0 && scaled.abs() < SMALL
}

#[inline(always)]
pub(crate) fn prepared_ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> FirstRay {
    let m = params.scene_exponent;
    let n = unit.exponent + m;
    let given = Vec3A::from(ray.origin);
    let origin = scale_point(given, m);
    let t_min = scale_by_power(ray.t_min, n).clamp(-FARTHEST, FARTHEST);
    let t_max = scale_by_power(ray.t_max, n).clamp(-FARTHEST, FARTHEST);
    let reach = largest(origin) + params.scene_size;
    let ordinary = params.plain
        && reach < LARGE
        && !lost(given, origin)
        && !lost(ray.direction.into(), unit.direction)
        && !lost_end(ray.t_min, t_min)
        && !lost_end(ray.t_max, t_max);
    let size = params.scene_size.max(1.0);
    let (origin, direction) = (Vector::from(origin.to_array()), Vector::from(unit.direction.to_array()));
    let reach = reach.max(1.0);
    let tiny = [power_of_two(-110) * reach * size, power_of_two(-100), power_of_two(-100) * reach * reach];
    let line = Line::new(UNIT, origin, direction, tiny, params.chords);
    FirstRay { line, t_min, t_max, ordinary }
}
