//! Twins of `shaders/exact/leaf/`: what the first stage makes of a leaf.

pub(crate) mod both_roots;
pub(crate) mod candidate;
pub(crate) mod crossings;
pub(crate) mod first_root;
pub(crate) mod nearest;
pub(crate) mod spheres;
pub(crate) mod triangles;

use candidate::Candidate;
use rayproof_scene::{Kind, Sphere};
use spheres::{TakeChord, intersect_spheres};
use triangles::intersect_triangles;

use super::ray::FirstRay;
use crate::lanes::Triangles4;

/// What has been found so far: `nearest`, or `crossings`.
pub(crate) trait Take {
    /// With a candidate in a place.
    fn take(self, ray: &FirstRay, candidate: Candidate<f32>, place: u32) -> Self;
}

/// What is found after a leaf of either kind.
pub(crate) trait TakeLeaf: Sized {
    fn take_leaf(self, kind: Kind, leaves: &[Triangles4], spheres: &[Sphere], ray: &FirstRay, word: u32) -> Self;
}

impl<F: TakeChord> TakeLeaf for F {
    #[inline(always)]
    fn take_leaf(self, kind: Kind, leaves: &[Triangles4], spheres: &[Sphere], ray: &FirstRay, word: u32) -> Self {
        match kind {
            Kind::Triangle => intersect_triangles(leaves, ray, word, self),
            Kind::Sphere => intersect_spheres(spheres, ray, word, self),
        }
    }
}
