//! Twin of `shaders/exact/values.wgsl`: `t`, `u` and `v` of a hit, rounded to the nearest `f32`.
//!
//! A value `q` known within `off` rounds as the exact one does where `q - off` and `q + off` round alike.

use rayproof_scene::Hit;

use super::candidate::Candidate;
use super::ray::{sphere_line, triangle_line};
use super::resolve::{self, Shape};
use super::second::SecondRay;
use super::two::{self, Two};
use super::{sphere, triangle};
use crate::lanes::Corners;
use crate::number::{Number, Vector};

/// A format wider than `f32`.
pub(crate) trait Wide: Number<Mask = bool> + PartialOrd {
    /// A number, exact.
    fn of(x: f64) -> Self;
    /// `self 2^-exponent` as the nearest `f32`, `inverse` being `2^-exponent`; never a negative zero.
    fn nearest(self, inverse: f64) -> f32;
}

impl Wide for f64 {
    #[inline(always)]
    fn of(x: f64) -> Self {
        x
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn nearest(self, inverse: f64) -> f32 {
        (self * inverse) as f32 + 0.0
    }
}

impl Wide for Two {
    fn of(x: f64) -> Self {
        x.into()
    }
    /// Rounded to odd first: of the two `f64` around the sum the one whose last bit is 1, so that rounding again is as rounding
    /// once.
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn nearest(self, inverse: f64) -> f32 {
        let Self { high, low } = self;
        let odd = if low == 0.0 || high.to_bits() & 1 == 1 {
            high
        } else if low > 0.0 {
            high.next_up()
        } else {
            high.next_down()
        };
        (odd * inverse) as f32 + 0.0
    }
}

/// A line in both forms that certificates take, and where its range begins.
struct Line<N> {
    triangle: triangle::Line<N>,
    sphere: sphere::Line<N>,
    t_min: N,
    /// What turns `t'` into `t`.
    inverse: f64,
}

/// The hit of a primitive that is hit in range; `doubts` counts what only exact arithmetic could round.
#[inline(always)]
pub(crate) fn round(ray: &SecondRay, shape: &Shape, primitive: u32, exponent: i32, doubts: &mut u32) -> Hit {
    let inverse = 2.0_f64.powi(-exponent);
    let line = Line { triangle: ray.triangle, sphere: ray.sphere, t_min: ray.exact.t_min, inverse };
    let [t, u, v] = rounded(&line, shape).unwrap_or_else(|| round_twice(ray, shape, exponent, doubts));
    Hit { t, u, v, primitive }
}

/// The same for the few that `f64` leaves open.
#[cold]
fn round_twice(ray: &SecondRay, shape: &Shape, exponent: i32, doubts: &mut u32) -> [f32; 3] {
    let (origin, direction) = (ray.triangle.origin.map(Two::from), ray.triangle.direction.map(Two::from));
    let line = Line {
        triangle: triangle_line(two::ROUNDOFF, origin, direction, Two::from(0.0)),
        sphere: sphere_line(two::ROUNDOFF, origin, direction, Two::from(0.0)),
        t_min: ray.exact.t_min.into(),
        inverse: 2.0_f64.powi(-exponent),
    };
    rounded(&line, shape).unwrap_or_else(|| {
        *doubts += 1;
        resolve::rounded(&ray.exact, shape, -exponent, [0.0; 3])
    })
}

#[inline(always)]
fn rounded<N: Wide>(line: &Line<N>, shape: &Shape) -> Option<[f32; 3]> {
    match *shape {
        Shape::Triangle([a, b, c]) => {
            let [a, b, c] = [a, b, c].map(|p| Vector::from(p).map(N::of));
            let edge = (b - a).largest().max((c - a).largest()) * N::constant(1.000_001);
            let sides = triangle::sides(&line.triangle, &Corners { a, b, c, edge });
            let (clear, t, off) = triangle::plane_t(&line.triangle, &sides, edge);
            if !clear {
                return None;
            }
            let t = settled(t, off, line.inverse)?;
            let weight = |x: N| {
                let (x, off) = triangle::weight(&line.triangle, &sides, x);
                settled(x, off, 1.0)
            };
            Some([t, weight(sides.u)?, weight(sides.v)?])
        }
        Shape::Sphere { center, radius } => {
            let chord = sphere::chord(&line.sphere, Vector::from(center).map(N::of), N::of(radius));
            let Candidate { certain, low, high } = Candidate::first_root(&chord, line.t_min);
            let (low, high) = (low.nearest(line.inverse), high.nearest(line.inverse));
            (certain && low == high).then_some([low, 0.0, 0.0])
        }
    }
}

/// What a value within `off` of `q` rounds to, where there is no choice.
#[inline(always)]
fn settled<N: Wide>(q: N, off: N, inverse: f64) -> Option<f32> {
    let (low, high) = ((q - off).nearest(inverse), (q + off).nearest(inverse));
    (low == high).then_some(low)
}
