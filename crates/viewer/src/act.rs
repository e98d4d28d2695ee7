//! What a panel, a key or finished work wants done; done in one place.

use std::path::PathBuf;
use std::sync::Arc;

use egui::Context;
use glam::Vec3;
use rayproof::Precision;
use rayproof::scene::Camera;

use crate::app::App;
use crate::model::look::Look;
use crate::model::navigate;
use crate::model::view::View;
use crate::model::world::World;
use crate::panels::inspector::{Inspector, Picked};
use crate::panels::plot::Plot;
use crate::settings::Panel;
use crate::standpoint::Standpoint;

/// What the window can do.
pub(crate) enum Act {
    /// Read a scene.
    Open(PathBuf),
    /// Ask for a scene's file.
    Choose,
    /// Hang a scene of a family of hard cases, both counted from 0.
    Hang { family: usize, scene: usize },
    /// Show a scene that was read from a file, or one that hangs in the gallery.
    Enter { world: Arc<World>, file: Option<PathBuf> },
    /// Say why a scene cannot be shown, until that is dismissed.
    Fault(String),
    /// Dismiss what was said of a scene.
    Dismiss,
    /// Show the scene in another way.
    Show(Look),
    /// Split the picture here, from 0 at the left to 1.
    SplitAt(f32),
    /// Open a panel on the right; close it where it is open.
    Toggle(Panel),
    /// See the scene from elsewhere.
    See(Camera),
    /// Turn to a point of the scene.
    LookAt(Vec3),
    /// Walk away, by powers of ten of the scene's size.
    WalkAway(f64),
    /// Go back to where the scene is seen from at first.
    Frame,
    /// Inspect a ray; where a precision is named, its answer is the one that is handed on.
    Inspect(Picked, Option<Precision>),
    /// Trace the picture with so many pixels, where that is not the one that is there.
    Trace([u32; 2]),
    /// Save the picture as soon as it is whole.
    SavePicture,
    /// Save the window as it is.
    SaveWindow,
    /// Copy a text, and tell so.
    Copy { text: String, told: String },
    /// Tell something for a while.
    Tell(String),
}

impl Act {
    /// Copies the camera as the table of a scene file.
    pub(crate) fn copy_camera(camera: &Camera) -> Self {
        Self::Copy { text: camera.table(), told: "copied the camera as a [camera] table".to_owned() }
    }
}

impl App {
    /// Does what is wanted, in this order.
    pub(crate) fn apply(&mut self, context: &Context, acts: impl IntoIterator<Item = Act>) {
        for act in acts {
            self.act(context, act);
        }
    }

    fn act(&mut self, context: &Context, act: Act) {
        match act {
            Act::Open(path) => self.opener.open(context, &path, &self.device),
            Act::Choose => self.opener.choose(context, self.settings.scene.as_deref(), &self.device),
            Act::Hang { family, scene } => self.gallery.hang(context, &self.device, family, scene),
            Act::Enter { world, file } => self.enter(world, file),
            Act::Fault(why) => self.opener.fault = Some(why),
            Act::Dismiss => self.opener.fault = None,
            Act::Show(look) => self.settings.look = look,
            Act::SplitAt(at) => self.settings.split_at = at,
            Act::Toggle(panel) => {
                let open = self.settings.panel == Some(panel);
                self.settings.panel = (!open).then_some(panel);
            }
            Act::See(camera) => self.standpoint.camera = camera,
            Act::LookAt(point) => self.standpoint.camera = navigate::focus(&self.standpoint.camera, point),
            Act::WalkAway(decades) => self.standpoint.walk_away(decades),
            Act::Frame => self.standpoint.frame(),
            Act::Inspect(picked, by) => {
                self.settings.panel = Some(Panel::Inspector);
                self.inspector.handed = by.or(self.inspector.handed);
                self.inspector.pick(context, &self.standpoint.world, picked, None);
            }
            Act::Trace(size) => self.trace(size),
            Act::SavePicture => self.saver.waits = true,
            Act::SaveWindow => self.saver.window(context, &self.standpoint.world.name),
            Act::Copy { text, told } => {
                context.copy_text(text);
                self.status.tell(context, told);
            }
            Act::Tell(what) => self.status.tell(context, what),
        }
    }

    /// Shows another scene from its first camera; what was known of the last one goes.
    fn enter(&mut self, world: Arc<World>, file: Option<PathBuf>) {
        if let Some(file) = file {
            self.settings.scene = std::path::absolute(file).ok();
            self.gallery.close();
        }
        self.standpoint = Standpoint::new(world);
        self.opener.fault = None;
        self.inspector = Inspector::default();
        self.plot = Plot::default();
    }

    fn trace(&mut self, size: [u32; 2]) {
        let Standpoint { world, camera, .. } = &self.standpoint;
        let view = View { world: world.clone(), camera: *camera, size, look: self.settings.look };
        let same = |(asked, _): &(View, u64)| asked.same_rays(&view) && asked.look == view.look;
        if !self.asked.as_ref().is_some_and(same) {
            let number = self.tracer.show(view.clone());
            self.asked = Some((view, number));
        }
    }
}
