//! The camera in motion by itself, to measure how fast pictures and frames come.

use std::time::Instant;

use egui::{Context, ViewportCommand};
use serde::Serialize;

use crate::app::App;
use crate::model::navigate;

/// The camera in motion: each move waits for the whole picture.
pub(crate) struct Motion {
    start: Instant,
    /// The view that was whole last; 0 at first.
    view: u64,
    moves: Vec<Move>,
    /// Seconds from frame to frame.
    frames: Vec<f64>,
    last: Instant,
}

impl Motion {
    pub(crate) fn new() -> Self {
        let now = Instant::now();
        Self { start: now, view: 0, moves: vec![], frames: vec![], last: now }
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

/// Moves the camera whenever the picture is whole, and notes the times; at the end prints them.
pub(crate) fn orbit(app: &mut App, context: &Context) {
    let (picture, progress) = {
        let picture = app.tracer.picture();
        (picture.view, picture.progress.clone())
    };
    let whole = app.is_whole();
    let Some(motion) = &mut app.script.motion else { return };
    let now = Instant::now();
    motion.frames.push(now.duration_since(motion.last).as_secs_f64());
    motion.last = now;
    if whole && picture != motion.view {
        // The picture that was there at first was no move: it may have waited for its tree.
        if let (Some(first), Some(whole), true) = (progress.first, progress.whole, motion.view > 0) {
            motion.moves.push(Move { first, whole });
        }
        motion.view = picture;
        app.camera = navigate::orbit(&app.camera, 0.02, 0.0);
    }
    if motion.start.elapsed().as_secs_f64() >= app.script.measure.unwrap_or(0.0) {
        print(app, progress.rate);
        app.script.motion = None;
        app.script.measure = None;
        if app.script.screenshot.is_none() {
            context.send_viewport_cmd(ViewportCommand::Close);
        }
    }
    context.request_repaint();
}

#[expect(clippy::print_stdout, reason = "what was asked for")]
fn print(app: &App, rays_per_second: f64) {
    let Some(motion) = &app.script.motion else { return };
    let spread = |times: Vec<f64>| {
        let mut times: Vec<f64> = times.into_iter().map(|t| (t * 1e5).round() / 1e2).collect();
        times.sort_unstable_by(f64::total_cmp);
        let at = |share: usize| times.get(times.len().saturating_sub(1) * share / 100).copied().unwrap_or(0.0);
        [at(50), at(95), at(100)]
    };
    let report = Responsiveness {
        device: app.device.info(rayproof::Precision::Exact).name,
        scene: app.world.name.clone(),
        size: app.canvas.size,
        moves: motion.moves.len(),
        first_picture_ms: spread(motion.moves.iter().map(|m| m.first).collect()),
        whole_picture_ms: spread(motion.moves.iter().map(|m| m.whole).collect()),
        frame_ms: spread(motion.frames.clone()),
        rays_per_second,
    };
    if let Ok(text) = serde_json::to_string_pretty(&report) {
        println!("{text}");
    }
}
