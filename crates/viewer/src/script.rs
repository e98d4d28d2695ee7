//! What the viewer does without a user: show something, take its own picture, measure itself.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use egui::{ColorImage, Context, ViewportCommand};

use crate::app::App;
use crate::model::navigate;
use crate::motion::{self, Motion};
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
    pub(crate) motion: Option<Motion>,
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
            return motion::orbit(app, context);
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
        app.script.motion = Some(Motion::new());
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

/// Writes the window's picture.
fn save(image: &ColorImage, path: &std::path::Path) -> Result<(), String> {
    let (size, rgb) = panels::toolbar::rgb(image);
    panels::toolbar::write_png(path, size, &rgb)
}
