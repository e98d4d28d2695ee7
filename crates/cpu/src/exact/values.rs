//! Twin of `shaders/exact/round/`: `t`, `u` and `v` of a hit, rounded to the nearest `f32`.
//!
//! A value `q` known within `off` rounds as the exact one does where `q - off` and `q + off` round alike.

use super::resolve::{self, Shape};
use super::second::SecondRay;
use super::wide::Wide;
use crate::lanes::Corners;
use crate::twin::exact::leaf::candidate::Candidate;
use crate::twin::exact::leaf::first_root::first_root;
use crate::twin::exact::line::Line;
use crate::twin::exact::sphere::chord;
use crate::twin::exact::triangle::{Estimate, plane_t, quotient, sides};
use crate::twin::exact::vector::Vector;

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

/// The three numbers of the few that `f64` leaves open.
#[cold]
fn round_again(ray: &SecondRay, shape: &Shape, exponent: i32, doubts: &mut u32) -> [f32; 3] {
    rounded(&ray.twice(shape), ray.exact.t_min.into(), shape, power_of_two(-exponent)).unwrap_or_else(|| {
        *doubts += 1;
        resolve::rounded(&ray.exact, shape, -exponent, [0.0; 3])
    })
}

/// `inverse` turns `t'` into `t`.
#[inline(always)]
fn rounded<N: Wide>(line: &Line<N>, t_min: N, shape: &Shape, inverse: f64) -> Option<[f32; 3]> {
    match *shape {
        Shape::Triangle([a, b, c]) => {
            let corners = Corners::widened([a, b, c]);
            let s = sides(line, &corners);
            let t = plane_t(line, &s, corners.edge);
            let [u, v] = [s.u, s.v].map(|x| quotient(line, &s, x, s.bound));
            t.clear.then_some([settled(t, inverse)?, settled(u, 1.0)?, settled(v, 1.0)?])
        }
        Shape::Sphere { center, radius } => {
            let c = chord(line, Vector::from(center).map(N::of), N::of(radius));
            let Candidate { certain, low, high } = first_root(&c, t_min);
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
