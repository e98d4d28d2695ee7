//! The ray that was picked, and what is known of it.

use std::sync::Arc;

use rayproof::Precision;
use rayproof::scene::Ray;

use crate::model::inspection::Inspection;
use crate::model::task::{Task, take};
use crate::model::world::World;

/// Where a picked ray comes from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picked {
    pub(crate) ray: Ray,
    /// The pixel; none for a ray of the gallery.
    pub(crate) pixel: Option<[u32; 2]>,
}

/// The ray that was picked, and its inspection.
#[derive(Default)]
pub(crate) struct Inspector {
    pub(crate) picked: Option<Picked>,
    task: Option<Task<Result<Inspection, String>>>,
    pub(crate) result: Option<Result<Inspection, String>>,
    /// The method whose answer is handed on.
    pub(crate) handed: Option<Precision>,
}

impl Inspector {
    /// Inspects a ray; the calculation is that of the primitive `wanted`, or of the one that it hits.
    pub(crate) fn pick(&mut self, context: &egui::Context, world: &Arc<World>, picked: Picked, wanted: Option<u32>) {
        let (world, ray) = (world.clone(), picked.ray);
        self.picked = Some(picked);
        self.task = Some(Task::start(context, move || Inspection::new(&world, ray, wanted).map_err(|e| e.to_string())));
    }

    /// Takes in the result when it is there.
    pub(crate) fn collect(&mut self) {
        match take(&mut self.task) {
            None => {}
            Some(Ok(result)) => self.result = Some(result),
            Some(Err(why)) => self.result = Some(Err(why.to_owned())),
        }
    }

    pub(crate) const fn is_busy(&self) -> bool {
        self.task.is_some()
    }
}
