//! What the viewer does without a user: show something, take its own picture, measure itself.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use egui::{ColorImage, Context, ViewportCommand};
use rayproof::Device;

use crate::act::Act;
use crate::model::view::Progress;
use crate::motion::Motion;
use crate::panels::inspector::Picked;
use crate::save;
use crate::standpoint::Standpoint;

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

/// What the script sees of the window.
pub(crate) struct Seen<'a> {
    /// Whether all that was asked for is shown.
    pub(crate) shown: bool,
    /// The number of the newest picture, and how it came about, when it is whole.
    pub(crate) whole: Option<(u64, Progress)>,
    /// Why a scene cannot be shown.
    pub(crate) fault: Option<&'a str>,
    pub(crate) standpoint: &'a Standpoint,
    /// Of the picture, in pixels.
    pub(crate) size: [u32; 2],
    /// How many scenes the family has that hangs.
    pub(crate) scenes: usize,
    pub(crate) device: &'a Device,
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
    pub(crate) fn step(&mut self, context: &Context, seen: &Seen<'_>) -> Option<Act> {
        if let Some(why) = seen.fault.filter(|_| self.is_unattended()) {
            return self.refuse(context, 5, why.to_owned());
        }
        if self.motion.is_some() {
            return self.orbit(context, seen);
        }
        if self.shot.is_some() {
            return self.shoot(context);
        }
        let act = if seen.shown { self.next(context, seen) } else { None };
        context.request_repaint_after(std::time::Duration::from_millis(20));
        act
    }

    /// Ends without what was asked for; where somebody looks, it is told in the window.
    fn refuse(&mut self, context: &Context, code: u8, message: String) -> Option<Act> {
        if !self.is_unattended() && code != 1 {
            return Some(Act::Fault(message));
        }
        *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(Failure { code, message });
        *self = Self { failure: self.failure.clone(), ..Self::default() };
        context.send_viewport_cmd(ViewportCommand::Close);
        None
    }

    fn next(&mut self, context: &Context, seen: &Seen<'_>) -> Option<Act> {
        if let Some([family, scene]) = self.family.take() {
            self.hanging = Some([family, scene]);
            return Some(Act::Hang { family: family.saturating_sub(1), scene: scene.saturating_sub(1) });
        }
        if let Some([family, scene]) = self.hanging.take() {
            let of = seen.scenes;
            let missing = || format!("--family {family}/{scene}: the family has {of} scenes");
            return if scene > of { self.refuse(context, 2, missing()) } else { None };
        }
        if let Some(decades) = self.distance.take() {
            return Some(Act::WalkAway(decades));
        }
        if let Some([x, y]) = self.inspect.take() {
            let [width, height] = seen.size;
            if x >= width || y >= height {
                let outside = format!("--inspect {x},{y}: the picture has {width} x {height} pixels");
                return self.refuse(context, 2, outside);
            }
            return Some(Act::Inspect(Picked::through(&seen.standpoint.camera, seen.size, [x, y]), None));
        }
        if self.measure.is_some() {
            self.motion = Some(Motion::new());
        } else if self.screenshot.is_some() {
            self.shot = Some(ask(context));
        }
        None
    }

    /// Moves the camera on; at the end prints how fast pictures came.
    fn orbit(&mut self, context: &Context, seen: &Seen<'_>) -> Option<Act> {
        context.request_repaint();
        let motion = self.motion.as_mut()?;
        let act = motion.orbit(seen);
        if motion.seconds() >= self.measure.unwrap_or(0.0) {
            motion.print(seen);
            self.motion = None;
            self.measure = None;
            if self.screenshot.is_none() {
                context.send_viewport_cmd(ViewportCommand::Close);
            }
        }
        act
    }

    /// Writes the picture of the window when it is there, and closes the window.
    fn shoot(&mut self, context: &Context) -> Option<Act> {
        context.request_repaint();
        let pixels = self.shot.as_ref()?.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        self.shot = None;
        let path = self.screenshot.take()?;
        let (size, rgb) = save::rgb(&pixels);
        if let Err(why) = save::write_png(&path, size, &rgb) {
            return self.refuse(context, 1, format!("{}: {why}", path.display()));
        }
        context.send_viewport_cmd(ViewportCommand::Close);
        None
    }
}

/// Asks for a picture of the window.
fn ask(context: &Context) -> Shot {
    let shot = Shot::default();
    let (given, waker) = (shot.clone(), context.clone());
    context.request_screenshot(move |image| {
        *given.lock().unwrap_or_else(PoisonError::into_inner) = Some(image);
        waker.request_repaint();
    });
    shot
}
