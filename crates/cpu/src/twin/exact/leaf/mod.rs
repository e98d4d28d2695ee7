//! Twins of `shaders/exact/leaf/`: what the first stage makes of a leaf.

pub(crate) mod both_roots;
pub(crate) mod candidate;
pub(crate) mod crossings;
pub(crate) mod first_root;
pub(crate) mod nearest;
pub(crate) mod spheres;
pub(crate) mod triangles;

use candidate::Candidate;

use super::ray::FirstRay;

/// What has been found so far: `nearest`, or `crossings`.
pub(crate) trait Take {
    /// With a candidate in a place.
    fn take(self, ray: &FirstRay, candidate: Candidate<f32>, place: u32) -> Self;
}
