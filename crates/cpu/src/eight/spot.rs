//! What `f32` leaves open of one primitive is asked of `f64` on the spot, so that few rays are walked a second time.
//!
//! The bounds are those of the second stage, whose certificates have no underflow to mind: products of three numbers within
//! `2^-100` and `2^55` are normal in `f64`. What it says is handed back to the walk in `f32`, rounded outward, so that the
//! walk's own comparisons stay what they are.

use rayproof_scene::{MISS, Ray};

use crate::exact::second::SecondRay;
use crate::primitives::Primitives;
use crate::twin::bvh::traverse::Found;
use crate::twin::exact::leaf::Take;
use crate::twin::exact::leaf::candidate::Candidate;
use crate::twin::exact::leaf::first_root::first_root;
use crate::twin::exact::leaf::nearest::Nearest;
use crate::twin::exact::leaf::spheres::TakeChord;
use crate::twin::exact::line::takes_chords;
use crate::twin::exact::ray::FirstRay;
use crate::twin::exact::sphere::Chord;
use crate::twin::leaf::word::place_kind;

/// The closest hit so far, with what it takes to ask `f64`.
#[derive(Clone, Copy)]
pub(super) struct OnTheSpot<'a, const ANY: bool> {
    pub(super) nearest: Nearest<ANY>,
    /// Nothing that `f32` alone left open is hit before this.
    single_doubt: f32,
    ray: &'a Ray,
    primitives: &'a Primitives,
    /// The exponent of the ray's direction: what turns `t'` of `f64` into the units of the walk.
    exponent: i32,
}

impl<'a, const ANY: bool> OnTheSpot<'a, ANY> {
    /// Before the first leaf.
    #[inline(always)]
    pub(super) fn start(primitives: &'a Primitives, ray: &'a Ray, exponent: i32, first: &FirstRay) -> Self {
        Self { nearest: Nearest::start(first), single_doubt: f32::INFINITY, ray, primitives, exponent }
    }

    /// Whether more than `f32` was needed, where the answer is certain.
    #[inline(always)]
    pub(super) fn needed(&self) -> bool {
        self.nearest.high >= self.single_doubt
    }

    /// What `f64` says of the primitive in a place, between `t` rounded outward; `None` for a miss in range.
    #[expect(clippy::cast_possible_truncation, reason = "a step outward from the nearest")]
    fn asked(&self, first: &FirstRay, place: u32) -> Option<Candidate<f32>> {
        let ray = SecondRay::new(self.ray, self.primitives.scale, takes_chords(place_kind(place)));
        let Candidate { certain, low, high } = ray.in_range(&self.primitives.shape(place))?;
        let to_first = 2.0_f64.powi(self.exponent);
        let low = ((low * to_first) as f32).next_down().max(first.t_min);
        let high = ((high * to_first) as f32).next_up().min(first.t_max);
        Some(Candidate { certain, low, high })
    }

    /// With a candidate that `f32` cannot place. Only what may change is handed back, so that the rest stays in registers.
    #[cold]
    #[inline(never)]
    fn sharpened(&self, first: &FirstRay, candidate: Candidate<f32>, place: u32) -> (Nearest<ANY>, f32) {
        let nearest = match self.asked(first, place) {
            None => self.nearest,
            Some(found) if found.certain => self.beside(first, found, place),
            // Both bounds hold: it is not hit before the later.
            Some(found) => self.nearest.doubting(found.low.max(candidate.low)),
        };
        (nearest, self.single_doubt.min(candidate.low))
    }

    /// With a certain hit, beside the one that is there.
    fn beside(&self, first: &FirstRay, found: Candidate<f32>, place: u32) -> Nearest<ANY> {
        let nearest = self.nearest;
        if nearest.slot == MISS || found.high < nearest.low {
            return nearest.with(found, place);
        }
        let Some(known) = self.asked(first, nearest.slot).filter(|known| known.certain) else {
            return nearest.doubting(found.low);
        };
        let nearest = Nearest { low: known.low.max(nearest.low), high: known.high.min(nearest.high), ..nearest };
        if found.high < nearest.low {
            nearest.with(found, place)
        } else if nearest.high < found.low {
            nearest
        } else {
            nearest.doubting(found.low)
        }
    }
}

impl<const ANY: bool> Found for OnTheSpot<'_, ANY> {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.nearest.reach()
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        self.nearest.finished()
    }
}

impl<const ANY: bool> Take for OnTheSpot<'_, ANY> {
    #[inline(always)]
    fn take(self, ray: &FirstRay, candidate: Candidate<f32>, place: u32) -> Self {
        if candidate.is_outside(ray.t_min, self.nearest.high) || self.finished() {
            return self;
        }
        if candidate.is_inside(ray.t_min, ray.t_max) && (candidate.high < self.nearest.low || self.nearest.slot == MISS)
        {
            return Self { nearest: self.nearest.with(candidate, place), ..self };
        }
        let (nearest, single_doubt) = self.sharpened(ray, candidate, place);
        Self { nearest, single_doubt, ..self }
    }
}

impl<const ANY: bool> TakeChord for OnTheSpot<'_, ANY> {
    #[inline(always)]
    fn take_chord(self, ray: &FirstRay, chord: &Chord<f32>, place: u32) -> Self {
        self.take(ray, first_root(chord, ray.t_min), place)
    }
}
