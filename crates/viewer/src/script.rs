//! What the viewer does without a user: show something, take its own picture, measure itself.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use egui::{ColorImage, Context, ViewportCommand};
use serde::Serialize;

use crate::app::App;
use crate::model::navigate;
use crate::panels;
use crate::settings::Side;

/// What is to be done, in this order, before the window closes; with nothing to do it stays.
#[derive(Default)]
pub struct Script {
    /// Hang a scene of a family of hard cases: the family's number, and the scene's from 1.
    pub family: Option<[usize; 2]>,
    /// Walk away, by so many powers of ten of the scene's size.
    pub distance: Option<f64>,
    /// Inspect a pixel of the picture.
    pub inspect: Option<[u32; 2]>,
    /// Orbit for so many seconds, and print how fast the pictures came.
    pub measure: Option<f64>,
    /// Write a picture of the window.
    pub screenshot: Option<PathBuf>,
    /// Which panel is open.
    pub panel: Option<Panel>,
    motion: Option<Motion>,
    shot: Option<Shot>,
}

/// A panel on the right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// None is open.
    None,
    /// One ray, and its calculation.
    Inspector,
    /// The hard cases.
    Gallery,
    /// Speed against error.
    Plot,
    /// Keys.
    Help,
}

/// A picture of the window that was asked for: first nothing, then the pixels.
type Shot = Arc<Mutex<Option<Arc<ColorImage>>>>;

/// The camera in motion: each move waits for the whole picture.
struct Motion {
    start: Instant,
    /// The view that was moved to last.
    view: u64,
    moves: Vec<Move>,
    /// Seconds from frame to frame.
    frames: Vec<f64>,
    last: Instant,
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

impl Script {
    /// Whether there is anything to do.
    pub(crate) const fn runs(&self) -> bool {
        self.family.is_some()
            || self.distance.is_some()
            || self.inspect.is_some()
            || self.measure.is_some()
            || self.screenshot.is_some()
            || self.shot.is_some()
    }

    /// Does the next thing, when the last one is done.
    pub(crate) fn step(app: &mut App, context: &Context) {
        if !app.script.runs() {
            return;
        }
        if let Some(panel) = app.script.panel.take() {
            app.settings.side = match panel {
                Panel::None => None,
                Panel::Inspector => Some(Side::Inspector),
                Panel::Gallery => Some(Side::Gallery),
                Panel::Plot => Some(Side::Plot),
                Panel::Help => Some(Side::Help),
            };
        }
        if app.script.motion.is_some() {
            return orbit(app, context);
        }
        if let Some(shot) = &app.script.shot {
            let pixels = shot.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(pixels) = pixels {
                app.script.shot = None;
                if let Some(path) = app.script.screenshot.take() {
                    save(&pixels, &path);
                }
                context.send_viewport_cmd(ViewportCommand::Close);
            }
            return context.request_repaint();
        }
        if app.is_shown() {
            next(app, context);
        }
        context.request_repaint_after(std::time::Duration::from_millis(20));
    }
}

fn next(app: &mut App, context: &Context) {
    if let Some([family, scene]) = app.script.family.take() {
        app.gallery.open(context, &app.device, family.saturating_sub(1), scene.saturating_sub(1));
    } else if let Some(decades) = app.script.distance.take() {
        app.gallery.decades = decades;
        app.camera = navigate::walk_away(&app.camera, &app.world.scene, decades);
    } else if let Some(pixel) = app.script.inspect.take() {
        let size = app.canvas.size;
        panels::pick(app, context, size, pixel);
    } else if app.script.measure.is_some() {
        let now = Instant::now();
        app.script.motion = Some(Motion { start: now, view: 0, moves: vec![], frames: vec![], last: now });
    } else if app.script.screenshot.is_some() {
        let shot = Shot::default();
        app.script.shot = Some(shot.clone());
        let waker = context.clone();
        context.request_screenshot(move |image| {
            *shot.lock().unwrap_or_else(PoisonError::into_inner) = Some(image);
            waker.request_repaint();
        });
    }
}

/// Moves the camera whenever the picture is whole, and notes the times; at the end prints them.
fn orbit(app: &mut App, context: &Context) {
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
        motion.view = picture;
        if let (Some(first), Some(whole)) = (progress.first, progress.whole) {
            motion.moves.push(Move { first, whole });
        }
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

#[expect(clippy::print_stderr, reason = "there is no window any more to tell it in")]
fn save(image: &ColorImage, path: &std::path::Path) {
    let rgb: Vec<u8> = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let size = image.size.map(|side| u32::try_from(side).unwrap_or(0));
    if let Err(why) = panels::toolbar::write_png(path, size, &rgb) {
        eprintln!("error: {}: {why}", path.display());
    }
}
