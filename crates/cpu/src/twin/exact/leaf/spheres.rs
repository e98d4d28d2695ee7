//! Twin of `shaders/exact/leaf/spheres.wgsl`.

use rayproof_scene::{Kind, Sphere};

use super::Take;
use super::both_roots::both_roots;
use super::crossings::Crossings;
use super::first_root::first_root;
use super::nearest::Nearest;
use crate::twin::exact::ray::FirstRay;
use crate::twin::exact::sphere::{Chord, chord};
use crate::twin::exact::vector::Vector;
use crate::twin::leaf::word::{leaf_range, place_of};

/// What is made of a chord: its first root in range, or both.
pub(crate) trait TakeChord: Take {
    fn take_chord(self, ray: &FirstRay, chord: &Chord<f32>, place: u32) -> Self;
}

impl<const ANY: bool> TakeChord for Nearest<ANY> {
    #[inline(always)]
    fn take_chord(self, ray: &FirstRay, chord: &Chord<f32>, place: u32) -> Self {
        self.take(ray, first_root(chord, ray.t_min), place)
    }
}

impl TakeChord for Crossings {
    #[inline(always)]
    fn take_chord(self, ray: &FirstRay, chord: &Chord<f32>, place: u32) -> Self {
        let [near, far] = both_roots(chord);
        self.take(ray, near, place).take(ray, far, place)
    }
}

/// With the spheres of a leaf that are not certainly missed.
#[inline(always)]
pub(crate) fn intersect_spheres<F: TakeChord>(spheres: &[Sphere], ray: &FirstRay, word: u32, before: F) -> F {
    let mut found = before;
    for i in leaf_range(word) {
        let Sphere { center, radius } = spheres[i];
        let c = chord(&ray.line, Vector::from(center.to_array()), radius);
        if !c.misses {
            found = found.take_chord(ray, &c, place_of(Kind::Sphere, i));
        }
    }
    found
}
