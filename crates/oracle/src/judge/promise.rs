use rayproof_scene::{FlatHit, Primitive, Ray};

use super::sphere::SpherePromise;
use super::triangle::TrianglePromise;
use crate::{ExactHit, Oracle, Root};

/// The unit roundoff of `f32`, 2^-24.
pub(super) const ROUNDOFF: f64 = f32::EPSILON as f64 / 2.0;
/// More than a few underflowing products lose, 2^-146.
pub(super) const TINY: f64 = 8.0 * f32::from_bits(1) as f64;
/// Where overflow is near, 2^125.
pub(super) const HUGE: f64 = f32::MAX as f64 / 8.0;

/// The finite ends of the range.
pub(super) fn ends(ray: &Ray) -> impl Iterator<Item = f32> + use<> {
    [ray.t_min, ray.t_max].into_iter().filter(|t| t.is_finite())
}

/// A value, and how far off single precision may be.
#[derive(Clone, Copy)]
pub(super) struct Bounded {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// What single precision promises for one ray and primitive.
pub(super) enum Promise {
    Triangle(TrianglePromise),
    Sphere(SpherePromise),
}

impl Promise {
    pub(super) fn new(ray: &Ray, primitive: &Primitive) -> Self {
        match primitive {
            Primitive::Triangle(triangle) => Self::Triangle(TrianglePromise::new(ray, triangle)),
            Primitive::Sphere(sphere) => Self::Sphere(SpherePromise::new(ray, sphere)),
        }
    }

    pub(super) fn of(oracle: &Oracle, ray: &Ray, flat: u32) -> Self {
        Self::new(ray, &oracle.scene().primitive(flat as usize))
    }

    pub(super) fn claim(&self, hit: &FlatHit) -> f64 {
        match self {
            Self::Triangle(promise) => promise.claim(hit),
            Self::Sphere(promise) => promise.claim(hit),
        }
    }

    pub(super) fn confuses_t(&self, t: &Root, x: f32) -> bool {
        match self {
            Self::Triangle(promise) => promise.confuses_t(x),
            Self::Sphere(promise) => promise.confuses_t(t.to_f64(), x),
        }
    }

    pub(super) fn may_miss(&self, ray: &Ray, hit: &ExactHit) -> bool {
        match self {
            Self::Triangle(promise) => promise.may_miss(ray),
            Self::Sphere(promise) => promise.may_miss(ray, hit.t.to_f64()),
        }
    }
}
