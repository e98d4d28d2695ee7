//! The second stage: the certificates of the first in `f64`, for every finite ray; what they leave open is decided on the spot,
//! in sums of two `f64` and at last exactly. On a device this is the pass of `shaders/exact/query/second.wgsl`, which leaves it
//! to the CPU.
//!
//! Positions are those of the scaled scene, the direction is as given: `t' = t 2^m`. No product over- or underflows: positions
//! lie below `2^260`, directions below `2^128`, and what is not zero is above `2^-150` each; no product has more than five
//! factors (`-750 > -1022`) or takes more than `2^800`.

use std::cmp::Ordering;

use rayproof_scene::{Kind, MISS, Ray};
use rayproof_tree::LEAF;

use super::resolve::{self, ExactRay, Shape};
use super::wide::Wide;
use crate::branch::Branch;
use crate::lanes::Corners;
use crate::primitives::Primitives;
use crate::twin::bvh::traverse::Found;
use crate::twin::exact::leaf::both_roots::both_roots;
use crate::twin::exact::leaf::candidate::{Candidate, candidate_at};
use crate::twin::exact::leaf::first_root::first_root;
use crate::twin::exact::line::{Line, takes_chords};
use crate::twin::exact::number::pair::Two;
use crate::twin::exact::number::{double, pair_of_f64};
use crate::twin::exact::sphere::chord;
use crate::twin::exact::triangle::{Estimate, plane_t, sides, triangle_crosses, triangle_misses};
use crate::twin::exact::vector::Vector;
use crate::twin::leaf::word::{leaf_count, leaf_first, leaf_kind, place_of};

/// A ray in `f64`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SecondRay {
    pub(crate) exact: ExactRay,
    pub(crate) line: Line<f64>,
}

impl SecondRay {
    /// `scale` is what the scene was multiplied by; `chords` tells whether a kind may be asked about that takes them.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray, scale: f64, chords: bool) -> Self {
        let origin = ray.origin.as_dvec3() * scale;
        let direction = ray.direction.as_dvec3();
        let exact = ExactRay {
            origin: origin.to_array(),
            direction: direction.to_array(),
            t_min: f64::from(ray.t_min) * scale,
            t_max: f64::from(ray.t_max) * scale,
        };
        let (origin, direction) = (Vector::from(exact.origin), Vector::from(exact.direction));
        Self { exact, line: Line::new(double::UNIT, origin, direction, [0.0; 3], chords) }
    }
}

/// A line and its range, in a format.
struct Asked<'a, N> {
    line: &'a Line<N>,
    t_min: N,
    t_max: N,
}

impl<N: Wide> Asked<'_, N> {
    /// What is known of one primitive: `None` for a certain miss.
    fn candidate(&self, shape: &Shape) -> Option<Candidate<N>> {
        match *shape {
            Shape::Triangle(corners) => {
                let corners = Corners::widened(corners);
                let s = sides(self.line, &corners);
                if triangle_misses(&s) {
                    return None;
                }
                let Estimate { clear, value, off } = plane_t(self.line, &s, corners.edge);
                let open = Candidate { certain: false, low: N::of(f64::NEG_INFINITY), high: N::of(f64::INFINITY) };
                let certain = triangle_crosses(&s);
                Some(if clear { Candidate { certain, ..candidate_at(value, off) } } else { open })
            }
            Shape::Sphere { center, radius } => {
                let c = chord(self.line, Vector::from(center).map(N::of), N::of(radius));
                (!c.misses).then(|| first_root(&c, self.t_min))
            }
        }
    }

    /// The crossings of one primitive, where certificates tell.
    fn count(&self, shape: &Shape) -> Option<u32> {
        let certain = |found: &Candidate<N>| {
            let outside = found.is_outside(self.t_min, self.t_max);
            (outside || found.is_inside(self.t_min, self.t_max)).then_some(u32::from(!outside))
        };
        match *shape {
            Shape::Triangle(_) => self.candidate(shape).as_ref().map_or(Some(0), certain),
            Shape::Sphere { center, radius } => {
                let c = chord(self.line, Vector::from(center).map(N::of), N::of(radius));
                if c.misses {
                    return Some(0);
                }
                both_roots(&c).iter().map(certain).sum()
            }
        }
    }
}

impl SecondRay {
    fn asked(&self) -> Asked<'_, f64> {
        Asked { line: &self.line, t_min: self.exact.t_min, t_max: self.exact.t_max }
    }

    /// Where `f64` finds a primitive in range, certainly or not; `None` for a certain miss.
    pub(crate) fn in_range(&self, shape: &Shape) -> Option<Candidate<f64>> {
        let ExactRay { t_min, t_max, .. } = self.exact;
        let found = self.asked().candidate(shape).filter(|found| !found.is_outside(t_min, t_max))?;
        Some(Candidate { certain: found.is_inside(t_min, t_max), ..found })
    }

    /// The line in sums of two `f64`, for one shape.
    pub(crate) fn twice(&self, shape: &Shape) -> Line<Two> {
        let (origin, direction) = (self.line.origin.map(Two::from), self.line.direction.map(Two::from));
        Line::new(pair_of_f64::UNIT, origin, direction, [Two::from(0.0); 3], takes_chords(shape.kind()))
    }

    /// Where a primitive is hit that `f64` left open; `None` for a miss.
    #[cold]
    fn refined(&self, shape: &Shape, found: Candidate<f64>, doubts: &mut u32) -> Option<Candidate<f64>> {
        let line = self.twice(shape);
        let asked = Asked { line: &line, t_min: self.exact.t_min.into(), t_max: self.exact.t_max.into() };
        let finer = asked.candidate(shape)?;
        if finer.is_outside(asked.t_min, asked.t_max) {
            return None;
        }
        if finer.is_inside(asked.t_min, asked.t_max) {
            // Outward from the leading halves.
            let (low, high) = (finer.low.high.next_down(), finer.high.high.next_up());
            return Some(Candidate { certain: true, low, high });
        }
        *doubts += 1;
        resolve::is_hit(&self.exact, shape).then_some(found)
    }

    /// The crossings of a primitive that `f64` left open.
    #[cold]
    fn refined_count(&self, shape: &Shape, doubts: &mut u32) -> u32 {
        let line = self.twice(shape);
        let asked = Asked { line: &line, t_min: self.exact.t_min.into(), t_max: self.exact.t_max.into() };
        asked.count(shape).unwrap_or_else(|| {
            *doubts += 1;
            resolve::crossings(&self.exact, shape)
        })
    }
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
struct Winner {
    slot: u32,
    shape: Shape,
    low: f64,
    high: f64,
}

/// The closest hit so far, or the first found where `ANY`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SecondNearest<const ANY: bool> {
    winner: Option<Winner>,
    /// Beyond this nothing is of interest, in the units of the first stage; and what turns `t'` into those.
    limit: f32,
    to_first: f64,
    /// How many questions only exact arithmetic could answer.
    pub(crate) doubts: u32,
}

impl<const ANY: bool> SecondNearest<ANY> {
    /// Before the first leaf.
    pub(crate) fn start(limit: f32, to_first: f64) -> Self {
        Self { winner: None, limit, to_first, doubts: 0 }
    }

    /// The primitive that is hit, by its place in the leaves, or [`MISS`].
    pub(crate) fn slot(&self) -> u32 {
        self.winner.map_or(MISS, |w| w.slot)
    }

    /// With what a leaf adds.
    pub(crate) fn leaf(mut self, primitives: &Primitives, ray: &SecondRay, word: u32) -> Self {
        for slot in slots(word) {
            let shape = primitives.shape(slot);
            let Some(mut found) = ray.asked().candidate(&shape) else { continue };
            let reach = self.winner.map_or(ray.exact.t_max, |w| w.high);
            if found.is_outside(ray.exact.t_min, reach) {
                continue;
            }
            if !found.is_inside(ray.exact.t_min, ray.exact.t_max) {
                let Some(finer) = ray.refined(&shape, found, &mut self.doubts) else { continue };
                found = finer;
            }
            let (low, high) = (found.low.max(ray.exact.t_min), found.high.min(ray.exact.t_max));
            let found = Winner { slot, shape, low, high };
            self.winner = Some(match self.winner {
                Some(before) if !goes_first(primitives, ray, &found, &before, &mut self.doubts) => before,
                _ => found,
            });
            if ANY {
                break;
            }
        }
        self
    }

    /// With what all leaves add: the walk in `f64`.
    pub(crate) fn all(self, nodes: &[impl Branch], primitives: &Primitives, ray: &SecondRay) -> Self {
        let mut found = self;
        walk(nodes, ray, |word| {
            found = found.leaf(primitives, ray, word);
            match found.winner {
                Some(_) if ANY => f64::NEG_INFINITY,
                winner => winner.map_or(ray.exact.t_max, |w| w.high),
            }
        });
        found
    }
}

impl<const ANY: bool> Found for SecondNearest<ANY> {
    #[expect(clippy::cast_possible_truncation, reason = "one step up from the nearest")]
    fn reach(&self) -> f32 {
        self.winner.map_or(self.limit, |w| ((w.high * self.to_first) as f32).next_up())
    }
    fn finished(&self) -> bool {
        ANY && self.winner.is_some()
    }
}

/// Whether a hit comes before another: the smaller `t`, and among equal `t` the lower number.
fn goes_first(primitives: &Primitives, ray: &SecondRay, found: &Winner, before: &Winner, doubts: &mut u32) -> bool {
    if found.high < before.low || before.high < found.low {
        return found.high < before.low;
    }
    *doubts += 1;
    match resolve::compare(&ray.exact, &found.shape, &before.shape) {
        Ordering::Less => true,
        Ordering::Equal => primitives.id(found.slot) < primitives.id(before.slot),
        Ordering::Greater => false,
    }
}

/// The place of the primitive that is hit first, by a walk in `f64`.
pub(crate) fn slot<const ANY: bool>(
    nodes: &[impl Branch],
    primitives: &Primitives,
    chords: bool,
    ray: &Ray,
    doubts: &mut u32,
) -> u32 {
    let ray = SecondRay::new(ray, primitives.scale, chords);
    let found = SecondNearest::<ANY>::start(f32::INFINITY, 1.0).all(nodes, primitives, &ray);
    *doubts += found.doubts;
    found.slot()
}

/// How often the surface is crossed.
pub(crate) fn count(nodes: &[impl Branch], primitives: &Primitives, ray: &SecondRay, doubts: &mut u32) -> u32 {
    let mut count = 0;
    walk(nodes, ray, |word| {
        for slot in slots(word) {
            let shape = primitives.shape(slot);
            count += ray.asked().count(&shape).unwrap_or_else(|| ray.refined_count(&shape, doubts));
        }
        ray.exact.t_max
    });
    count
}

/// The places of a leaf's primitives.
fn slots(word: u32) -> impl Iterator<Item = u32> {
    let kind = leaf_kind(word);
    let first = match kind {
        Kind::Triangle => leaf_first(word) * 4,
        Kind::Sphere => leaf_first(word),
    };
    (first..first + leaf_count(word)).map(move |index| place_of(kind, index))
}

/// Calls `leaf` with the words of the leaves whose boxes the ray meets, roughly from near to far; it returns beyond which `t'`
/// nothing more is of interest.
///
/// A plane is off by three roundings relative to its `t'`, which the pad covers; an axis along which the ray does not move is
/// compared as it is. Scaling a subnormal down rounds, by less than `2^-148`: the boxes grow by that.
fn walk(nodes: &[impl Branch], ray: &SecondRay, mut leaf: impl FnMut(u32) -> f64) {
    let mut reach = ray.exact.t_max;
    let inverse = ray.exact.direction.map(|d| 1.0 / d);
    let mut stack = Vec::with_capacity(64);
    stack.push((f64::NEG_INFINITY, 0));
    while let Some((enter, word)) = stack.pop() {
        if enter > reach {
            continue;
        }
        if word >= LEAF {
            reach = leaf(word);
            continue;
        }
        let node = &nodes[word as usize];
        let base = stack.len();
        for k in node.slots() {
            if let Some(enter) = entered(&ray.exact, inverse, node.child_box(k), reach) {
                stack.push((enter, node.child(k)));
            }
        }
        stack[base..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    }
}

/// Where a box is entered, at the earliest; `None` where it is missed.
fn entered(ray: &ExactRay, inverse: [f64; 3], [low, high]: [[f32; 3]; 2], reach: f64) -> Option<f64> {
    const GROW: f64 = 1.0 / (1_u128 << 74) as f64 / (1_u128 << 74) as f64;
    const PAD: f64 = 1.0 / (1_u64 << 50) as f64;
    let (mut enter, mut leave) = (ray.t_min, reach);
    for axis in 0..3 {
        let (low, high) = (f64::from(low[axis]) - GROW, f64::from(high[axis]) + GROW);
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        if d == 0.0 {
            if o < low || o > high {
                return None;
            }
            continue;
        }
        let (near, far) = if d > 0.0 { (low, high) } else { (high, low) };
        let (near, far) = ((near - o) * inverse[axis], (far - o) * inverse[axis]);
        enter = enter.max(near - near.abs() * PAD);
        leave = leave.min(far + far.abs() * PAD);
    }
    (enter <= leave).then_some(enter)
}
