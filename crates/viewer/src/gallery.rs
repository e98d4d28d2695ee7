//! The exhibit that hangs now.

use std::sync::Arc;

use rayproof::{Device, Error};

use crate::model::gallery::{Answered, Exhibit};
use crate::model::task::{Task, take};
use crate::model::world::World;

/// Where in the gallery the user is.
#[derive(Default)]
pub(crate) struct Gallery {
    opening: Option<Task<Result<Exhibit, Error>>>,
    pub(crate) hung: Option<Hung>,
    /// How far away the camera was moved, in powers of ten.
    pub(crate) decades: f64,
}

/// A scene of a family, and the answers to its rays.
pub(crate) struct Hung {
    pub(crate) family: usize,
    pub(crate) number: usize,
    pub(crate) of: usize,
    pub(crate) rays: Vec<Answered>,
}

impl Gallery {
    /// Hangs a scene of a family.
    pub(crate) fn open(&mut self, context: &egui::Context, device: &Device, family: usize, number: usize) {
        let device = device.clone();
        self.opening = Some(Task::start(context, move || Exhibit::open(family, number, device)));
    }

    /// Takes the exhibit down: another scene is shown.
    pub(crate) fn close(&mut self) {
        self.hung = None;
        self.decades = 0.0;
    }

    pub(crate) const fn is_opening(&self) -> bool {
        self.opening.is_some()
    }

    /// The world of a new exhibit, when it is there.
    pub(crate) fn collect(&mut self) -> Option<Result<Arc<World>, String>> {
        match take(&mut self.opening)? {
            Ok(Ok(Exhibit { world, family, number, of, rays })) => {
                self.close();
                self.hung = Some(Hung { family, number, of, rays });
                Some(Ok(Arc::new(world)))
            }
            Ok(Err(error)) => Some(Err(error.to_string())),
            Err(why) => Some(Err(why.to_owned())),
        }
    }
}
