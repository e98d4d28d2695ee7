//! The precisions in `f32`, and those that round at the end: each a choice of formulas.

use glam::Vec4;
use rayproof_scene::{Ray, Sphere};

use crate::f64x4::F64x4;
use crate::lanes::{Candidates, Triangles4};
use crate::twin::batch::Params;
use crate::twin::bvh::slab::UnitDirection;
use crate::twin::exact::number::pair::Two;
use crate::twin::leaf::single::{Candidate, SingleRay};
use crate::twin::{classic, double, fast, textbook};

/// How a precision computes hits.
pub(crate) trait Formulas {
    fn ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> SingleRay;
    fn triangles(ray: &SingleRay, triangles: &Triangles4) -> Candidates;
    fn sphere(ray: &SingleRay, sphere: &Sphere) -> Candidate;
}

macro_rules! formulas {
    ($($name:ident: $ray:expr, $triangles:expr, $sphere:expr;)+) => {$(
        pub(crate) struct $name;

        impl Formulas for $name {
            #[inline(always)]
            fn ray(params: &Params, ray: &Ray, unit: &UnitDirection) -> SingleRay {
                $ray(params, ray, unit)
            }
            #[inline(always)]
            fn triangles(ray: &SingleRay, triangles: &Triangles4) -> Candidates {
                $triangles(ray, triangles)
            }
            #[inline(always)]
            fn sphere(ray: &SingleRay, sphere: &Sphere) -> Candidate {
                $sphere(ray, sphere)
            }
        }
    )+};
}

formulas! {
    Textbook: classic::prepared_ray, classic::intersect_triangle, textbook::intersect_sphere;
    Classic: classic::prepared_ray, classic::intersect_triangle, classic::intersect_sphere;
    Fast: fast::prepared_ray, fast::intersect_triangle, fast::intersect_sphere;
    Pair: fast::prepared_ray, double::intersect_triangle::<Two<Vec4>>, double::intersect_sphere::<Two<f32>>;
    Double: fast::prepared_ray, double::intersect_triangle::<F64x4>, double::intersect_sphere::<f64>;
}
