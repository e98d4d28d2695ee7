//! Twin of `shaders/exact/round/`: `t`, `u` and `v` of a hit, rounded to the nearest `f32`.
//!
//! A value `q` known within `off` rounds as the exact one does where `q - off` and `q + off` round alike.

use super::candidate::Candidate;
use super::line::Line;
use super::resolve::{self, Shape};
use super::second::SecondRay;
use super::triangle::Estimate;
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

/// `2^n`, well within the range of `f64`.
#[inline(always)]
fn power_of_two(n: i32) -> f64 {
    f64::from_bits(u64::from((n + 1023).unsigned_abs()) << 52)
}

/// `t`, `u` and `v` of a primitive that is hit in range; `doubts` counts what only exact arithmetic could round.
#[inline(always)]
pub(crate) fn round(ray: &SecondRay, shape: &Shape, exponent: i32, doubts: &mut u32) -> [f32; 3] {
    let inverse = power_of_two(-exponent);
    rounded(&ray.line, ray.exact.t_min, shape, inverse).unwrap_or_else(|| round_again(ray, shape, exponent, doubts))
}

/// The same for the few that `f64` leaves open.
#[cold]
fn round_again(ray: &SecondRay, shape: &Shape, exponent: i32, doubts: &mut u32) -> [f32; 3] {
    let (origin, direction) = (ray.line.origin.map(Two::from), ray.line.direction.map(Two::from));
    let spheres = matches!(shape, Shape::Sphere { .. });
    let line = Line::new(two::ROUNDOFF, origin, direction, [Two::from(0.0); 2], spheres);
    rounded(&line, ray.exact.t_min.into(), shape, power_of_two(-exponent)).unwrap_or_else(|| {
        *doubts += 1;
        resolve::rounded(&ray.exact, shape, -exponent, [0.0; 3])
    })
}

/// `inverse` turns `t'` into `t`.
#[inline(always)]
fn rounded<N: Wide>(line: &Line<N>, t_min: N, shape: &Shape, inverse: f64) -> Option<[f32; 3]> {
    match *shape {
        Shape::Triangle([a, b, c]) => {
            let [a, b, c] = [a, b, c].map(|p| Vector::from(p).map(N::of));
            let edge = (b - a).largest().max((c - a).largest()) * N::constant(1.000_001);
            let sides = triangle::sides(line, &Corners { a, b, c, edge });
            let t = triangle::plane_t(line, &sides, edge);
            let [u, v] = [sides.u, sides.v].map(|x| triangle::quotient(line, &sides, x, sides.bound));
            t.clear.then_some([settled(t, inverse)?, settled(u, 1.0)?, settled(v, 1.0)?])
        }
        Shape::Sphere { center, radius } => {
            let chord = sphere::chord(line, Vector::from(center).map(N::of), N::of(radius));
            let Candidate { certain, low, high } = Candidate::first_root(&chord, t_min);
            let (low, high) = (low.nearest(inverse), high.nearest(inverse));
            (certain && low == high).then_some([low, 0.0, 0.0])
        }
    }
}

/// What a value rounds to, where there is no choice.
#[inline(always)]
fn settled<N: Wide>(Estimate { value, off, .. }: Estimate<N>, inverse: f64) -> Option<f32> {
    let (low, high) = ((value - off).nearest(inverse), (value + off).nearest(inverse));
    (low == high).then_some(low)
}
