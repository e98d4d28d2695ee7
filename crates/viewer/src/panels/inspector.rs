//! The calculation of one ray, by every method.

use egui::{Grid, RichText, Ui};
use glam::Vec3;
use rayproof::Precision;
use rayproof::scene::{FlatHit, Primitive, Ray, Scene, number};
use rayproof_oracle::judge::ulp_distance;
use rayproof_oracle::worked::Value;
use rayproof_picture::shade::Verdict;

use super::calculation::{self, marked};
use super::words::{list, many};
use crate::app::App;
use crate::inspector::Picked;
use crate::model::inspection::Inspection;

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ui.heading("Inspector");
    let Some(picked) = app.inspector.picked.clone() else {
        ui.label("Click a pixel of the picture to read how its ray is answered, by every method and exactly.");
        return;
    };
    if app.inspector.is_busy() {
        ui.spinner();
    }
    match app.inspector.result.clone() {
        None => {}
        Some(Err(why)) => {
            ui.colored_label(ui.visuals().error_fg_color, why);
        }
        Some(Ok(inspection)) => {
            answers(ui, &app.world.scene, &inspection);
            hand_on(app, ui, &inspection);
            chooser(app, ui, &inspection, &picked);
            if let Some((flat, worked)) = &inspection.worked {
                calculation::show(ui, worked);
                primitive(ui, &app.world.scene, *flat);
            }
            ray(ui, &inspection.ray, &picked);
        }
    }
}

/// A heading.
pub(super) fn strong(ui: &mut Ui, text: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(text).strong());
}

/// Text whose digits line up.
pub(super) fn mono(ui: &mut Ui, text: impl Into<String>) -> egui::Response {
    ui.label(RichText::new(text).monospace())
}

/// What each method answers, over the whole scene.
fn answers(ui: &mut Ui, scene: &Scene, inspection: &Inspection) {
    strong(ui, "Answers");
    let truth = &inspection.truth;
    Grid::new("answers").num_columns(4).striped(true).show(ui, |ui| {
        let heads = [
            ("method", "How t was computed"),
            ("primitive", "geometry / primitive, as in the files of hits"),
            ("t", "Where on the ray, in multiples of its direction"),
            ("ULP off", "How many f32 numbers lie between this t and the exact one, rounded once"),
        ];
        for (head, explained) in heads {
            ui.label(RichText::new(head).weak()).on_hover_text(explained);
        }
        ui.end_row();
        let named = Precision::ALL.map(Precision::name).into_iter().zip(&inspection.hits);
        for (name, hit) in named.chain([("oracle", truth)]) {
            ui.label(name);
            if hit.is_hit() {
                mono(ui, place(scene, hit.primitive));
                let [exact, shown] = [truth.t, hit.t].map(Value::F32);
                let hex = format!("t = {}\nu = {:?}\nv = {:?}", number::hex(hit.t), hit.u, hit.v);
                ui.label(marked(ui, &shown, &exact, 9)).on_hover_text(hex);
            } else {
                ui.label("miss");
                ui.label("");
            }
            ui.label(off(truth, hit));
            ui.end_row();
        }
    });
}

/// A primitive as files of hits name it: its geometry, and its row there.
fn place(scene: &Scene, flat: u32) -> String {
    let (geometry, row) = scene.locate(flat as usize);
    format!("{geometry} / {row}")
}

fn off(truth: &FlatHit, hit: &FlatHit) -> String {
    match Verdict::of(truth, hit) {
        Verdict::Miss => String::new(),
        Verdict::Hit => many(ulp_distance(truth.t, hit.t)),
        wrong => wrong.name().to_owned(),
    }
}

/// The case, to be replayed elsewhere.
fn hand_on(app: &mut App, ui: &mut Ui, inspection: &Inspection) {
    ui.horizontal_wrapped(|ui| {
        let precision = app.inspector.handed.unwrap_or(app.settings.look.left.precision);
        if ui
            .button("Copy as a one-ray case")
            .on_hover_text("Shell commands that ask `rayproof intersect` again")
            .clicked()
        {
            let text = inspection.commands(&app.world.scene, precision);
            ui.ctx().copy_text(text);
            app.tell(ui.ctx(), format!("copied the commands that replay the answer of {}", precision.name()));
        }
        let mut chosen = precision;
        list(ui, "as answered by", chosen.name(), |ui| {
            for p in Precision::ALL {
                ui.selectable_value(&mut chosen, p, p.name());
            }
        });
        if chosen != precision {
            app.inspector.handed = Some(chosen);
        }
    });
}

fn ray(ui: &mut Ui, ray: &Ray, picked: &Picked) {
    let of = picked.pixel.map_or_else(String::new, |[x, y]| format!(" of the pixel {x}, {y}"));
    strong(ui, &format!("Ray{of}"));
    Grid::new("ray").num_columns(4).striped(true).show(ui, |ui| {
        vector(ui, "origin e", ray.origin);
        vector(ui, "direction d", ray.direction);
        for (name, t) in [("t_min", ray.t_min), ("t_max", ray.t_max)] {
            ui.label(name);
            both(ui, t);
            ui.end_row();
        }
    });
}

/// The components of a vector, a line each.
fn vector(ui: &mut Ui, name: &str, v: Vec3) {
    for (axis, x) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
        ui.label(format!("{name}.{axis}"));
        both(ui, x);
        ui.end_row();
    }
}

/// A number in decimal, and as it is stored.
fn both(ui: &mut Ui, x: f32) {
    mono(ui, format!("{x:?}"));
    mono(ui, number::hex(x));
}

/// Which primitive's calculation is shown.
fn chooser(app: &mut App, ui: &mut Ui, inspection: &Inspection, picked: &Picked) {
    let Some((flat, _)) = inspection.worked else { return };
    strong(ui, "Primitive");
    if inspection.hits.iter().all(|hit| !hit.is_hit()) {
        ui.label("No method hits anything: choose one to see why it is missed.");
    }
    let mut chosen = flat;
    let scene = &app.world.scene;
    ui.horizontal(|ui| {
        list(ui, "geometry / primitive", &place(scene, flat), |ui| {
            for &candidate in &inspection.candidates {
                ui.selectable_value(&mut chosen, candidate, place(scene, candidate));
            }
        });
        let last = scene.len().saturating_sub(1);
        let label = ui.label("or number").on_hover_text("Counted through all geometries, from 0");
        ui.add(egui::DragValue::new(&mut chosen).range(0..=last).speed(0.1)).labelled_by(label.id);
    });
    if chosen != flat {
        app.inspector.pick(ui.ctx(), &app.world, picked.clone(), Some(chosen));
    }
}

fn primitive(ui: &mut Ui, scene: &Scene, flat: u32) {
    let (geometry, row) = scene.locate(flat as usize);
    let shape = scene.primitive(flat as usize);
    strong(ui, &format!("The {} {row} of geometry {geometry}", shape.kind().name()));
    Grid::new("primitive").num_columns(3).striped(true).show(ui, |ui| match shape {
        Primitive::Sphere(sphere) => {
            vector(ui, "center c", sphere.center);
            ui.label("radius r");
            both(ui, sphere.radius);
            ui.end_row();
        }
        Primitive::Triangle(t) => {
            for (name, corner) in [("a", t.a), ("b", t.b), ("c", t.c)] {
                vector(ui, name, corner);
            }
        }
    });
}
