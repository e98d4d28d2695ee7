//! Twin of `shaders/batch.wgsl`. How many rays there are and where they lie is the engine's.

use rayproof_tree::Bvh;

use crate::twin::exact::line::takes_chords;

/// What every ray of a batch shares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Params {
    pub(crate) scene_exponent: i32,
    pub(crate) scene_size: f32,
    /// Whether the precision `exact` has bounds for this scene in `f32`.
    pub(crate) plain: bool,
    /// Whether a kind in the scene takes the parts of a line for chords.
    pub(crate) chords: bool,
}

impl Params {
    pub(crate) fn new<N>(bvh: &Bvh<N>) -> Self {
        Self {
            scene_exponent: bvh.scale_exponent,
            scene_size: bvh.size,
            plain: bvh.plain,
            chords: bvh.kinds().iter().any(takes_chords),
        }
    }
}
