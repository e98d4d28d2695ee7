//! A picture that is wanted, and how far it is.

use std::sync::Arc;

use rayproof::scene::{Camera, Pixels};
use rayproof_picture::color::Rgb;

use super::look::{Look, Source};
use super::paint::Figures;
use super::world::World;

/// What is wanted.
#[derive(Clone)]
pub(crate) struct View {
    pub(crate) world: Arc<World>,
    pub(crate) camera: Camera,
    /// Width and height in pixels, neither zero.
    pub(crate) size: [u32; 2],
    pub(crate) look: Look,
}

impl View {
    pub(super) fn pixels(&self) -> Pixels {
        self.camera.pixels(self.size[0], self.size[1])
    }

    /// Whether the same rays are shot at the same scene.
    pub(crate) fn same_rays(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.world, &other.world) && self.camera == other.camera && self.size == other.size
    }
}

/// A picture, as far as it is.
#[derive(Clone, Default)]
pub(crate) struct Picture {
    /// The number of the view that it shows; they count up.
    pub(crate) view: u64,
    pub(crate) size: [u32; 2],
    /// How it is shown.
    pub(crate) look: Look,
    /// The pixels; and those right of the split.
    pub(crate) sides: [Vec<Rgb>; 2],
    /// About each side, when it is whole.
    pub(crate) figures: [Option<Figures>; 2],
    pub(crate) progress: Progress,
    /// Counts up whenever the pixels change.
    pub(crate) version: u64,
}

/// How far a picture is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Progress {
    /// What is done now, or what went wrong.
    pub(crate) state: State,
    /// The share of all rays that are answered.
    pub(crate) traced: f64,
    /// Pixels whose exact answer the oracle has given too, and how many there are; none where nothing is judged.
    pub(crate) judged: Option<[usize; 2]>,
    /// For how many of those it contradicts the precision exact: their exact answer is then the oracle's.
    pub(crate) contradicted: usize,
    /// Seconds from the wish to the first picture, and to the whole one.
    pub(crate) first: Option<f64>,
    pub(crate) whole: Option<f64>,
    /// Rays a second while tracing.
    pub(crate) rate: f64,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum State {
    #[default]
    Idle,
    Building(Source),
    Tracing,
    Judging,
    Done,
    Failed(String),
}
