//! Twin of `shaders/exact/ray.wgsl`: a ray as the first tier takes it.

use glam::{Vec3A, Vec4};
use rayproof_scene::Ray;

use super::{sphere, triangle};
use crate::batch::Params;
use crate::bvh::slab::{FARTHEST, UnitDirection};
use crate::bvh::traverse::TierRay;
use crate::math::{largest, power_of_two, scale_by_power, scale_point};
use crate::number::{Number, Vector};

/// What rounding to nearest loses at most, relative to the result.
const ROUNDOFF: f32 = power_of_two(-24);

/// Beyond `SMALL` and `LARGE` no bound is proven: such a ray is left to the tier that has no limits.
const SMALL: f32 = power_of_two(-100);
const LARGE: f32 = power_of_two(55);

/// A scaled ray with the parts of the error bounds that depend on it alone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstRay {
    pub(crate) triangle: triangle::Line<f32>,
    pub(crate) sphere: sphere::Line<f32>,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// Whether the bounds hold.
    pub(crate) ordinary: bool,
}

impl TierRay for FirstRay {
    #[inline(always)]
    fn origin(&self) -> Vec3A {
        let o = self.triangle.origin;
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

/// The same of an end of the range.
#[inline(always)]
fn lost_end(given: f32, scaled: f32) -> bool {
    given != 0.0 && scaled.abs() < SMALL
}

#[inline(always)]
pub(crate) fn first_ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> FirstRay {
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
    let triangle = triangle_line(ROUNDOFF, origin, direction, power_of_two(-110) * reach.max(1.0) * size);
    let tiny = power_of_two(-100) * reach.max(1.0) * reach.max(1.0);
    let sphere = sphere_line(ROUNDOFF, origin, direction, tiny);
    FirstRay { triangle, sphere, t_min, t_max, ordinary }
}

/// The line with its bounds in an arithmetic of roundoff `u`, a power of two.
#[inline(always)]
pub(crate) fn triangle_line<N: Number>(u: f32, origin: Vector<N>, direction: Vector<N>, tiny: N) -> triangle::Line<N> {
    let times = |k: f32| N::constant(k * u);
    triangle::Line {
        origin,
        direction,
        side_error: direction.manhattan() * times(20.0),
        plane_error: times(54.0),
        tiny,
        round_error: times(8.0),
    }
}

/// The same for spheres.
#[inline(always)]
pub(crate) fn sphere_line<N: Number>(u: f32, origin: Vector<N>, direction: Vector<N>, tiny: N) -> sphere::Line<N> {
    let times = |k: f32| N::constant(k * u);
    let inverse_a = N::constant(1.0) / crate::number::dot3(direction, direction);
    sphere::Line {
        origin,
        direction,
        inverse_a,
        foot_error: times(28.0),
        middle_error: inverse_a.sqrt() * times(28.0),
        round_error: times(12.0),
        tiny,
    }
}

/// The same number in four lanes.
pub(crate) trait Splat {
    type Lanes;
    fn lanes(&self) -> Self::Lanes;
}

impl Splat for triangle::Line<f32> {
    type Lanes = triangle::Line<Vec4>;

    #[inline(always)]
    fn lanes(&self) -> Self::Lanes {
        triangle::Line {
            origin: self.origin.map(Vec4::splat),
            direction: self.direction.map(Vec4::splat),
            side_error: Vec4::splat(self.side_error),
            plane_error: Vec4::splat(self.plane_error),
            tiny: Vec4::splat(self.tiny),
            round_error: Vec4::splat(self.round_error),
        }
    }
}
