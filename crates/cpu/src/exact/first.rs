//! Twin of the files in `shaders/exact/leaf/`: what the first stage makes of a leaf.

use glam::Vec4;
use rayproof_scene::{MISS, Sphere};

use super::candidate::Candidate;
use super::ray::FirstRay;
use super::triangle::Estimate;
use super::{sphere, triangle};
use crate::bvh::slab::FARTHEST;
use crate::bvh::traverse::Found;
use crate::lanes::Triangles4;
use crate::leaf::{SPHERES, leaf_range};
use crate::number::Vector;

/// The certain hit that is closest so far and how near one might be that is not certain. Where `ANY`, the first certain
/// hit ends the walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct First<const ANY: bool> {
    /// The exact `t` lies between.
    pub(crate) low: f32,
    pub(crate) high: f32,
    /// The primitive, by its place in the leaves; [`MISS`] for none.
    pub(crate) slot: u32,
    /// No primitive left open is hit before this.
    pub(crate) doubt: f32,
}

impl<const ANY: bool> First<ANY> {
    #[inline(always)]
    pub(crate) fn start(ray: &FirstRay) -> Self {
        Self { low: ray.t_max, high: ray.t_max, slot: MISS, doubt: f32::INFINITY }
    }

    /// Whether the answer is certain.
    #[inline(always)]
    pub(crate) fn decided(&self) -> bool {
        (ANY && self.slot != MISS) || self.high < self.doubt
    }

    /// Between which `t` the hit lies, if there is one.
    pub(crate) fn window(&self) -> [f32; 2] {
        [self.low.min(self.doubt), self.high]
    }

    #[inline(always)]
    fn merge(self, ray: &FirstRay, found: Candidate<f32>, slot: u32) -> Self {
        if found.is_outside(ray.t_min, self.high) {
            return self;
        }
        if found.is_inside(ray.t_min, ray.t_max) && (found.high < self.low || self.slot == MISS) {
            return Self { low: found.low, high: found.high, slot, doubt: self.doubt };
        }
        Self { doubt: self.doubt.min(found.low), ..self }
    }
}

impl<const ANY: bool> Found for First<ANY> {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.high
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        ANY && self.slot != MISS
    }
}

/// How many certain crossings there are so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    pub(crate) count: u32,
    /// Whether one was not certain.
    pub(crate) open: bool,
    t_max: f32,
}

impl Crossings {
    #[inline(always)]
    pub(crate) fn start(ray: &FirstRay) -> Self {
        Self { count: 0, open: false, t_max: ray.t_max }
    }

    #[inline(always)]
    fn merge(self, ray: &FirstRay, found: Candidate<f32>) -> Self {
        if found.is_outside(ray.t_min, ray.t_max) {
            return self;
        }
        if found.is_inside(ray.t_min, ray.t_max) {
            return Self { count: self.count + 1, ..self };
        }
        Self { open: true, ..self }
    }
}

impl Found for Crossings {
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.t_max
    }
    #[inline(always)]
    fn finished(&self) -> bool {
        self.open
    }
}

/// The triangles of a leaf that are not certainly missed.
#[inline(always)]
fn open_triangles(leaf: &Triangles4, ray: &FirstRay, word: u32, mut take: impl FnMut(Candidate<f32>, usize)) {
    let line = ray.line.lanes();
    let sides = triangle::sides(&line, &leaf.corners);
    let lanes = 0b1111 >> (3 - ((word >> 28) & 3));
    let mut left = !triangle::misses(&sides).bitmask() & lanes;
    if left == 0 {
        return;
    }
    let crosses = triangle::crosses(&sides);
    let Estimate { clear, value: t, off } = triangle::plane_t(&line, &sides, leaf.corners.edge);
    let low = Vec4::select(clear, t - off, Vec4::splat(-FARTHEST));
    let high = Vec4::select(clear, t + off, Vec4::splat(FARTHEST));
    let certain = (crosses & clear).bitmask();
    while left != 0 {
        let k = left.trailing_zeros() as usize;
        left &= left - 1;
        take(Candidate { certain: certain >> k & 1 == 1, low: low[k], high: high[k] }, k);
    }
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a leaf's word names it in 28 bits")]
pub(crate) fn intersect_triangles<const ANY: bool>(
    leaves: &[Triangles4],
    ray: &FirstRay,
    word: u32,
    mut found: First<ANY>,
) -> First<ANY> {
    let index = leaf_range(word).start;
    open_triangles(
        &leaves[index],
        ray,
        word,
        #[inline(always)]
        |candidate, k| {
            found = found.merge(ray, candidate, (index * 4 + k) as u32);
        },
    );
    found
}

#[inline(always)]
pub(crate) fn count_triangles(leaves: &[Triangles4], ray: &FirstRay, word: u32, mut found: Crossings) -> Crossings {
    open_triangles(&leaves[leaf_range(word).start], ray, word, |candidate, _| found = found.merge(ray, candidate));
    found
}

/// The chord of a sphere that is not certainly missed.
#[inline(always)]
fn open_chord(ray: &FirstRay, &Sphere { center, radius }: &Sphere) -> Option<sphere::Chord<f32>> {
    let chord = sphere::chord(&ray.line, Vector::from(center.to_array()), radius);
    (!chord.misses).then_some(chord)
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "a leaf's word names it in 28 bits")]
pub(crate) fn intersect_spheres<const ANY: bool>(
    spheres: &[Sphere],
    ray: &FirstRay,
    word: u32,
    mut found: First<ANY>,
) -> First<ANY> {
    for i in leaf_range(word) {
        if let Some(chord) = open_chord(ray, &spheres[i]) {
            found = found.merge(ray, Candidate::first_root(&chord, ray.t_min), SPHERES | i as u32);
        }
    }
    found
}

#[inline(always)]
pub(crate) fn count_spheres(spheres: &[Sphere], ray: &FirstRay, word: u32, mut found: Crossings) -> Crossings {
    for i in leaf_range(word) {
        if let Some(chord) = open_chord(ray, &spheres[i]) {
            for root in Candidate::both_roots(&chord) {
                found = found.merge(ray, root);
            }
        }
    }
    found
}
