//! The camera in motion by itself, to measure how fast pictures and frames come.

use std::time::Instant;

use serde::Serialize;

use crate::act::Act;
use crate::model::navigate;
use crate::script::Seen;

/// The camera in motion: each move waits for the whole picture.
pub(crate) struct Motion {
    start: Instant,
    /// The view that was whole last; 0 at first.
    view: u64,
    moves: Vec<Move>,
    /// Seconds from frame to frame.
    frames: Vec<f64>,
    last: Instant,
    /// Of the last whole picture.
    rays_per_second: f64,
}

impl Motion {
    pub(crate) fn new() -> Self {
        let now = Instant::now();
        Self { start: now, view: 0, moves: vec![], frames: vec![], last: now, rays_per_second: 0.0 }
    }
}

/// Seconds from a move to its first picture, and to the whole one.
#[derive(Clone, Copy, Serialize)]
struct Move {
    first: f64,
    whole: f64,
}

/// What a measurement prints.
#[derive(Serialize)]
struct Responsiveness {
    device: String,
    scene: String,
    size: [u32; 2],
    moves: usize,
    /// Milliseconds: the median, the 95th percentile, the worst.
    first_picture_ms: [f64; 3],
    whole_picture_ms: [f64; 3],
    frame_ms: [f64; 3],
    rays_per_second: f64,
}

impl Motion {
    /// Notes the times of a picture that is whole, and moves the camera on.
    pub(crate) fn orbit(&mut self, seen: &Seen<'_>) -> Option<Act> {
        let now = Instant::now();
        self.frames.push(now.duration_since(self.last).as_secs_f64());
        self.last = now;
        let (picture, progress) = seen.whole.as_ref().filter(|(picture, _)| *picture != self.view)?;
        // The picture that was there at first was no move: it may have waited for its tree.
        if let (Some(first), Some(whole), true) = (progress.first, progress.whole, self.view > 0) {
            self.moves.push(Move { first, whole });
        }
        self.view = *picture;
        self.rays_per_second = progress.rate;
        Some(Act::See(navigate::orbit(&seen.standpoint.camera, 0.02, 0.0)))
    }

    /// Seconds since it began.
    pub(crate) fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    #[expect(clippy::print_stdout, reason = "what was asked for")]
    pub(crate) fn print(&self, seen: &Seen<'_>) {
        let report = Responsiveness {
            device: seen.device.info(rayproof::Precision::Exact).name,
            scene: seen.standpoint.world.name.clone(),
            size: seen.size,
            moves: self.moves.len(),
            first_picture_ms: spread(self.moves.iter().map(|m| m.first)),
            whole_picture_ms: spread(self.moves.iter().map(|m| m.whole)),
            frame_ms: spread(self.frames.iter().copied()),
            rays_per_second: self.rays_per_second,
        };
        if let Ok(text) = serde_json::to_string_pretty(&report) {
            println!("{text}");
        }
    }
}

/// The median, the 95th percentile and the worst of times in seconds, in milliseconds.
fn spread(times: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut times: Vec<f64> = times.map(|t| (t * 1e5).round() / 1e2).collect();
    times.sort_unstable_by(f64::total_cmp);
    [50, 95, 100].map(|share| times.get(times.len().saturating_sub(1) * share / 100).copied().unwrap_or(0.0))
}
