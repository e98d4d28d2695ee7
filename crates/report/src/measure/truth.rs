//! What is exact of one ray, asked of the oracle once for all precisions.

use glam::DVec3;
use rayon::prelude::*;
use rayproof::scene::{FlatHit, Primitive, Ray, Scene, Triangle};
use rayproof_oracle::Oracle;

/// The exact closest hit.
pub(crate) struct Truth {
    /// Its numbers rounded to the nearest `f32`; or a miss.
    pub(crate) hit: FlatHit,
    /// `t`, `u`, `v` to some 50 bits.
    pub(crate) t: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
    /// What perturbing every input by one rounding, `2^-24`, may move `t` by. None where the surface is met along itself.
    pub(crate) sway: Option<f64>,
}

impl Truth {
    /// The exact closest hit of each ray.
    pub(crate) fn of(scene: &Scene, rays: &[Ray]) -> Vec<Self> {
        let oracle = Oracle::new(scene);
        rays.par_iter().map(|ray| Self::one(&oracle, ray)).collect()
    }

    fn one(oracle: &Oracle, ray: &Ray) -> Self {
        let Some(exact) = oracle.closest(ray) else {
            return Self { hit: FlatHit::MISS, t: f64::INFINITY, u: 0.0, v: 0.0, sway: None };
        };
        let (t, u, v) = (exact.t.to_f64(), exact.u.to_f64().value(), exact.v.to_f64().value());
        let primitive = oracle.scene().primitive(exact.primitive as usize);
        Self { hit: exact.to_hit(), t, u, v, sway: sway(ray, &primitive, t) }
    }
}

/// `|t| kappa_t u` with the condition number `kappa_t = (|e| + |c| + r + |t d|) / (|t d| |cos|)`, `cos` that of the
/// angle between the
/// ray and the surface's normal: to first order, `f(e + t d) = 0` with unit normal `n` moves by
/// `|dt| <= (|de| + |dc| + |dr| + |t| |dd|) / (|d| |cos|)`. Of a triangle the largest vertex takes the place of `|c| + r`.
fn sway(ray: &Ray, primitive: &Primitive, t: f64) -> Option<f64> {
    let (e, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let (normal, size) = match primitive {
        Primitive::Sphere(sphere) => {
            let c = sphere.center.as_dvec3();
            ((e - c) + d * t, c.length() + f64::from(sphere.radius))
        }
        Primitive::Triangle(triangle) => {
            let [a, b, c] = corners(triangle);
            ((b - a).cross(c - a), a.length().max(b.length()).max(c.length()))
        }
    };
    // Scaled first: lengths of 1e-30 and 1e30 have no squares in f64's range that would not cancel below.
    let cosine = normal.try_normalize()?.dot(d.try_normalize()?).abs();
    let sway = (e.length() + size + t.abs() * d.length()) / (d.length() * cosine) * 2.0_f64.powi(-24);
    (cosine > 1e-12 && sway.is_finite() && sway > 0.0).then_some(sway)
}

/// A triangle's vertices in `f64`.
pub(crate) fn corners(t: &Triangle) -> [DVec3; 3] {
    [t.a, t.b, t.c].map(|v| v.as_dvec3())
}
