//! A precision's answers against the exact ones, added up.

use rayproof::scene::{FlatHit, Primitive, Ray, Scene};

use super::statistics::{quantiles, rate};
use super::truth::{Truth, corners};
use crate::model::Errors;

/// The verdicts and errors of a precision.
#[derive(Default)]
pub(crate) struct Tally {
    rays: u64,
    hits: u64,
    missed: u64,
    false_hits: u64,
    both: u64,
    wrong_primitive: u64,
    t: Vec<f64>,
    u: Vec<f64>,
    v: Vec<f64>,
    normalised: Vec<f64>,
    residual: Vec<f64>,
    gap: Vec<f64>,
    /// The largest error of `t`, and where.
    pub(crate) worst: Option<(f64, Place)>,
    /// The first misclassified ray.
    pub(crate) first_wrong: Option<Place>,
}

/// A ray: its scene's number among those that were added, its own number in that, and the answer to it.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) scene: usize,
    pub(crate) ray: usize,
    pub(crate) answer: FlatHit,
}

impl Tally {
    /// Adds the answers to the rays of one scene.
    pub(crate) fn add(&mut self, number: usize, scene: &Scene, rays: &[Ray], truth: &[Truth], answers: &[FlatHit]) {
        for (i, ((ray, truth), answer)) in rays.iter().zip(truth).zip(answers).enumerate() {
            let place = Place { scene: number, ray: i, answer: *answer };
            let right = self.verdict(truth, answer);
            if !right && self.first_wrong.is_none() {
                self.first_wrong = Some(place);
            }
            if right && truth.hit.is_hit() {
                let ulp = self.measure(scene, ray, truth, answer);
                if self.worst.is_none_or(|(worst, _)| ulp > worst) {
                    self.worst = Some((ulp, place));
                }
            }
        }
    }

    /// Counts the verdict; whether it is right.
    fn verdict(&mut self, truth: &Truth, answer: &FlatHit) -> bool {
        self.rays += 1;
        self.hits += u64::from(truth.hit.is_hit());
        match (truth.hit.is_hit(), answer.is_hit()) {
            (false, false) => true,
            (true, false) => {
                self.missed += 1;
                false
            }
            (false, true) => {
                self.false_hits += 1;
                false
            }
            (true, true) => {
                self.both += 1;
                let same = truth.hit.primitive == answer.primitive;
                self.wrong_primitive += u64::from(!same);
                same
            }
        }
    }

    /// Adds the errors of a hit whose primitive is right; returned is that of `t` in ULP.
    fn measure(&mut self, scene: &Scene, ray: &Ray, truth: &Truth, answer: &FlatHit) -> f64 {
        let ulp = ulps(answer.t, truth.t, truth.hit.t);
        self.t.push(ulp);
        if let Some(sway) = truth.sway.filter(|_| truth.hit.t.is_finite()) {
            self.normalised.push((value(answer.t) - truth.t).abs() / (sway + 0.5 * unit(truth.t)));
        }
        let (d, t) = (ray.direction.as_dvec3(), f64::from(answer.t));
        let p = ray.origin.as_dvec3() + d * t;
        let mut residual = f64::NAN;
        match scene.primitive(answer.primitive as usize) {
            Primitive::Sphere(sphere) => {
                let (o, r) = (p - sphere.center.as_dvec3(), f64::from(sphere.radius));
                residual = (o.length() - r).abs() * (o.length() + r) / (r * r);
            }
            Primitive::Triangle(triangle) => {
                self.u.push(ulps(answer.u, truth.u, truth.hit.u));
                self.v.push(ulps(answer.v, truth.v, truth.hit.v));
                let [a, b, c] = corners(&triangle);
                let size = (b - a).length().max((c - a).length()).max((c - b).length());
                if let Some(normal) = (b - a).cross(c - a).try_normalize() {
                    residual = (p - a).dot(normal).abs() / size;
                }
                let point = a + (b - a) * f64::from(answer.u) + (c - a) * f64::from(answer.v);
                push_finite(&mut self.gap, p.distance(point) / size);
            }
        }
        push_finite(&mut self.residual, residual);
        ulp
    }

    /// What it came to; the cases are made by whoever knows the scenes.
    pub(crate) fn errors(self) -> Errors {
        Errors {
            rays: self.rays,
            misses: rate(self.missed, self.hits),
            false_hits: rate(self.false_hits, self.rays - self.hits),
            wrong_primitive: rate(self.wrong_primitive, self.both),
            wrong: rate(self.missed + self.false_hits + self.wrong_primitive, self.rays),
            t: quantiles(self.t),
            u: quantiles(self.u),
            v: quantiles(self.v),
            normalised: quantiles(self.normalised),
            residual: quantiles(self.residual),
            gap: quantiles(self.gap),
            worst: None,
            first_wrong: None,
        }
    }
}

fn push_finite(list: &mut Vec<f64>, x: f64) {
    if x.is_finite() {
        list.push(x);
    }
}

/// How far a number is off, in units of the last place of the exact one: half at most where it is the nearest.
///
/// Infinity stands for `2^128`, where rounding overflows, and so does NaN.
pub(crate) fn ulps(answer: f32, exact: f64, nearest: f32) -> f64 {
    if answer.to_bits() == nearest.to_bits() {
        // The exact number lies within half a unit; beside a power of two its own unit may be the smaller one.
        let off = (f64::from(answer) - exact).abs() / unit(exact);
        return if answer.is_finite() { off.min(0.5) } else { 0.0 };
    }
    (value(answer) - exact.clamp(-OVERFLOW, OVERFLOW)).abs() / unit(exact)
}

/// Where rounding to `f32` overflows.
const OVERFLOW: f64 = 340_282_366_920_938_463_463_374_607_431_768_211_456.0; // 2^128

fn value(answer: f32) -> f64 {
    if answer.is_finite() { f64::from(answer) } else { OVERFLOW.copysign(f64::from(answer)) }
}

/// The distance between the `f32` numbers around `x`.
pub(crate) fn unit(x: f64) -> f64 {
    let exponent = (x.abs().to_bits() >> 52).cast_signed() - 1023;
    #[expect(clippy::cast_possible_truncation, reason = "eleven bits")]
    let exponent = exponent.clamp(-126, 127) as i32;
    2.0_f64.powi(exponent - 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_the_last_place() {
        assert_eq!(ulps(1.0, 1.0, 1.0), 0.0);
        assert_eq!(ulps(1.0, 1.0 + 2.0_f64.powi(-25), 1.0), 0.25);
        assert_eq!(ulps(1.0_f32.next_up(), 1.0, 1.0), 1.0);
        assert_eq!(ulps(1.0_f32.next_down(), 1.0, 1.0), 0.5, "below a power of two numbers are twice as dense");
        assert_eq!(ulps(0.0, 2.0_f64.powi(-150), 0.0), 0.5);
        assert_eq!(ulps(f32::from_bits(3), 0.0, 0.0), 3.0);
        assert_eq!(ulps(-1.0, 1.0, 1.0), 2.0_f64.powi(24));
        assert_eq!(ulps(f32::INFINITY, 1e39, f32::INFINITY), 0.0);
        assert_eq!(ulps(f32::MAX, 1e39, f32::INFINITY), 1.0);
        assert_eq!(ulps(f32::INFINITY, 1.0, 1.0), 2.0_f64.powi(151) - 2.0_f64.powi(23));
        assert_eq!(ulps(f32::NAN, 1.0, 1.0), 2.0_f64.powi(151) - 2.0_f64.powi(23));
    }
}
