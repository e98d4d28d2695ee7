//! The ray that was picked: what every precision answers, and the calculation behind it.

mod answers;
mod calculation;
mod shapes;

use std::sync::Arc;

use egui::{Context, DragValue, RichText, Ui};
use rayproof::Precision;
use rayproof::scene::{Camera, Ray, Scene};

use super::words::list;
use crate::act::Act;
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

impl Picked {
    /// The ray through a pixel of a picture.
    pub(crate) fn through(camera: &Camera, [width, height]: [u32; 2], [x, y]: [u32; 2]) -> Self {
        Self { ray: camera.pixels(width, height).ray(x, y), pixel: Some([x, y]) }
    }
}

/// The ray that was picked, and its inspection.
#[derive(Default)]
pub(crate) struct Inspector {
    pub(crate) picked: Option<Picked>,
    task: Option<Task<Result<Inspection, String>>>,
    pub(crate) result: Option<Result<Inspection, String>>,
    /// The precision whose answer is handed on; else that of the picture.
    pub(crate) handed: Option<Precision>,
}

impl Inspector {
    /// Inspects a ray; the calculation is that of the primitive `wanted`, or of the one that it hits.
    pub(crate) fn pick(&mut self, context: &Context, world: &Arc<World>, picked: Picked, wanted: Option<u32>) {
        let (world, ray) = (world.clone(), picked.ray);
        self.picked = Some(picked);
        self.task = Some(Task::start(context, move || Inspection::new(&world, ray, wanted).map_err(|e| e.to_string())));
    }

    /// Takes in the result when it is there.
    pub(crate) fn collect(&mut self) {
        if let Some(result) = take(&mut self.task) {
            self.result = Some(result.unwrap_or_else(|why| Err(why.to_owned())));
        }
    }

    pub(crate) const fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// Shows it; `shown` is the precision of the picture.
    pub(crate) fn show(&mut self, ui: &mut Ui, world: &Arc<World>, shown: Precision) -> Vec<Act> {
        let mut acts = Vec::new();
        ui.heading("Inspector");
        let Some(picked) = self.picked.clone() else {
            ui.label("Click a pixel of the picture to read how its ray is answered, by every precision and exactly.");
            return acts;
        };
        if self.is_busy() {
            ui.spinner();
        }
        match self.result.clone() {
            None => {}
            Some(Err(why)) => {
                ui.colored_label(ui.visuals().error_fg_color, why);
            }
            Some(Ok(inspection)) => {
                answers::show(ui, &world.scene, &inspection);
                acts.extend(self.hand_on(ui, &world.scene, &inspection, shown));
                if let Some(other) = chooser(ui, &world.scene, &inspection) {
                    self.pick(ui.ctx(), world, picked.clone(), Some(other));
                }
                if let Some((flat, worked)) = &inspection.worked {
                    calculation::show(ui, worked);
                    shapes::primitive(ui, &world.scene, *flat);
                }
                shapes::ray(ui, &inspection.ray, &picked);
            }
        }
        acts
    }

    /// The case, to be replayed elsewhere.
    fn hand_on(&mut self, ui: &mut Ui, scene: &Scene, inspection: &Inspection, shown: Precision) -> Option<Act> {
        let what = "Shell commands that ask `rayproof intersect` again";
        let mut act = None;
        ui.horizontal_wrapped(|ui| {
            let precision = self.handed.unwrap_or(shown);
            if ui.button("Copy as a one-ray case").on_hover_text(what).clicked() {
                let told = format!("copied the commands that replay the answer of {}", precision.name());
                act = Some(Act::Copy { text: inspection.commands(scene, precision), told });
            }
            let mut chosen = precision;
            list(ui, "as answered by", chosen.name(), |ui| {
                for p in Precision::ALL {
                    ui.selectable_value(&mut chosen, p, p.name());
                }
            });
            if chosen != precision {
                self.handed = Some(chosen);
            }
        });
        act
    }
}

/// Which primitive's calculation is shown; returned is another one that is wanted, by its flat number.
fn chooser(ui: &mut Ui, scene: &Scene, inspection: &Inspection) -> Option<u32> {
    let (flat, _) = inspection.worked.as_ref()?;
    strong(ui, "Primitive");
    if inspection.hits.iter().all(|hit| !hit.is_hit()) {
        ui.label("No precision hits anything: choose a primitive to see why it is missed.");
    }
    let mut chosen = *flat;
    ui.horizontal(|ui| {
        list(ui, "geometry / primitive", &address(scene, *flat), |ui| {
            for &candidate in &inspection.candidates {
                ui.selectable_value(&mut chosen, candidate, address(scene, candidate));
            }
        });
        let last = scene.len().saturating_sub(1);
        let label = ui.label("or number").on_hover_text("Counted through all geometries, from 0");
        ui.add(DragValue::new(&mut chosen).range(0..=last).speed(0.1)).labelled_by(label.id);
    });
    (chosen != *flat).then_some(chosen)
}

/// A primitive as files of hits name it: its geometry, and its row there.
fn address(scene: &Scene, flat: u32) -> String {
    let (geometry, row) = scene.locate(flat as usize);
    format!("{geometry} / {row}")
}

/// A heading.
fn strong(ui: &mut Ui, text: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(text).strong());
}

/// Text whose digits line up.
fn mono(ui: &mut Ui, text: impl Into<String>) -> egui::Response {
    ui.label(RichText::new(text).monospace())
}
