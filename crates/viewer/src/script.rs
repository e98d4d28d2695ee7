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
    /// Why it came to nothing.
    pub failure: Arc<Mutex<Option<Failure>>>,
    /// The scene of a family that was asked for, until it hangs.
    hanging: Option<[usize; 2]>,
    motion: Option<Motion>,
    shot: Option<Shot>,
}

/// Why what was to be done could not be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The exit code: 1 failed while running, 2 usage, 5 bad input.
    pub code: u8,
    /// What is wrong, and what would be right.
    pub message: String,
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

impl Panel {
    pub(crate) const fn side(self) -> Option<Side> {
        match self {
            Self::None => None,
            Self::Inspector => Some(Side::Inspector),
            Self::Gallery => Some(Side::Gallery),
            Self::Plot => Some(Side::Plot),
            Self::Help => Some(Side::Help),
        }
    }
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
            || self.hanging.is_some()
            || self.is_unattended()
    }

    /// Whether there is nobody to look at the window.
    const fn is_unattended(&self) -> bool {
        self.measure.is_some() || self.screenshot.is_some() || self.shot.is_some()
    }

    /// Does the next thing, when the last one is done.
    pub(crate) fn step(app: &mut App, context: &Context) {
        if !app.script.runs() {
            return;
        }
        if let Some(why) = app.fault.clone().filter(|_| app.script.is_unattended()) {
            return refuse(app, context, 5, why);
        }
        if app.script.motion.is_some() {
            return orbit(app, context);
        }
        if let Some(shot) = &app.script.shot {
            let pixels = shot.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(pixels) = pixels {
                app.script.shot = None;
                if let Some(path) = app.script.screenshot.take()
                    && let Err(why) = save(&pixels, &path)
                {
                    return refuse(app, context, 1, format!("{}: {why}", path.display()));
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

/// Ends without what was asked for; where somebody looks, it is told in the window.
fn refuse(app: &mut App, context: &Context, code: u8, message: String) {
    if !app.script.is_unattended() && code != 1 {
        app.fault = Some(message);
        return;
    }
    *app.script.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(Failure { code, message });
    app.script = Script { failure: app.script.failure.clone(), ..Script::default() };
    context.send_viewport_cmd(ViewportCommand::Close);
}

fn next(app: &mut App, context: &Context) {
    if let Some([family, scene]) = app.script.family.take() {
        app.script.hanging = Some([family, scene]);
        app.gallery.open(context, &app.device, family.saturating_sub(1), scene.saturating_sub(1));
    } else if let Some([family, scene]) = app.script.hanging.take() {
        let of = app.gallery.hung.as_ref().map_or(0, |hung| hung.of);
        if scene > of {
            refuse(app, context, 2, format!("--family {family}/{scene}: the family has {of} scenes"));
        }
    } else if let Some(decades) = app.script.distance.take() {
        app.gallery.decades = decades;
        app.camera = navigate::walk_away(&app.camera, &app.world.scene, decades);
    } else if let Some([x, y]) = app.script.inspect.take() {
        let [width, height] = app.canvas.size;
        if x < width && y < height {
            panels::pick(app, context, [width, height], [x, y]);
        } else {
            refuse(app, context, 2, format!("--inspect {x},{y}: the picture has {width} x {height} pixels"));
        }
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

/// Writes the window's picture.
fn save(image: &ColorImage, path: &std::path::Path) -> Result<(), String> {
    let rgb: Vec<u8> = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let size = image.size.map(|side| u32::try_from(side).unwrap_or(0));
    panels::toolbar::write_png(path, size, &rgb)
}
