//! What is shown, by which precisions, and from where.

use egui::{RichText, ScrollArea, Slider, Ui};
use rayproof::Precision;

use super::canvas::Canvas;
use super::figures;
use super::words::{list, short};
use crate::act::Act;
use crate::model::look::{Look, Mode, Place, Source};
use crate::model::navigate;
use crate::settings::Settings;
use crate::standpoint::Standpoint;

/// Shows the panel on the left. `last` is the pixel that was picked last: figures lead on from there.
pub(crate) fn show(
    ui: &mut Ui,
    settings: &Settings,
    has_device: bool,
    standpoint: &Standpoint,
    canvas: &Canvas,
    last: Option<[u32; 2]>,
) -> Vec<Act> {
    let (mut look, mut split_at) = (settings.look, settings.split_at);
    let mut acts = Vec::new();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        part(ui, "Show", |ui| modes(ui, &mut look));
        part(ui, "Precision", |ui| precisions(ui, &mut look, &mut split_at, has_device));
        part(ui, "Camera", |ui| acts.extend(camera(ui, standpoint, canvas.size)));
        part(ui, "Figures", |ui| acts.extend(figures::show(ui, canvas, &standpoint.camera, last)));
    });
    if look != settings.look {
        acts.push(Act::Show(look));
    }
    if split_at.to_bits() != settings.split_at.to_bits() {
        acts.push(Act::SplitAt(split_at));
    }
    acts
}

/// A part under its heading. Each has its own identity: a slider is held on to when parts above it come and go.
fn part(ui: &mut Ui, title: &str, content: impl FnOnce(&mut Ui)) {
    ui.push_id(title, |ui| {
        ui.heading(title);
        content(ui);
        ui.add_space(6.0);
    });
}

fn modes(ui: &mut Ui, look: &mut Look) {
    ui.columns(2, |columns| {
        for (i, mode) in Mode::ALL.into_iter().enumerate() {
            let column = &mut columns[usize::from(i >= Mode::ALL.len().div_ceil(2))];
            let explained = format!("{} ({})", mode.explains(), i + 1);
            column.radio_value(&mut look.mode, mode, mode.name()).on_hover_text(explained);
        }
    });
    ui.label(RichText::new(look.mode.explains()).weak());
}

fn precisions(ui: &mut Ui, look: &mut Look, split_at: &mut f32, has_device: bool) {
    if look.mode == Mode::Stage {
        ui.label("The cascade of the precision exact.");
        return;
    }
    let differs = look.mode == Mode::Difference;
    choice(ui, "precision", &mut look.left, has_device);
    if differs {
        choice(ui, "against", &mut look.right, has_device);
        return;
    }
    ui.checkbox(&mut look.split, "split the picture").on_hover_text("Between two precisions (X)");
    if look.split {
        choice(ui, "right of the split", &mut look.right, has_device);
        ui.horizontal(|ui| {
            let label = ui.label("split at");
            let slider = Slider::new(split_at, 0.0..=1.0).show_value(false);
            ui.add(slider).labelled_by(label.id);
        });
    }
}

/// Picks a precision and, where there is a device, the place where it runs.
fn choice(ui: &mut Ui, label: &str, source: &mut Source, has_device: bool) {
    list(ui, label, source.precision.name(), |ui| {
        for precision in Precision::ALL {
            ui.selectable_value(&mut source.precision, precision, precision.name()).on_hover_text(about(precision));
        }
    });
    if has_device {
        ui.horizontal(|ui| {
            ui.radio_value(&mut source.place, Place::Device, "device");
            ui.radio_value(&mut source.place, Place::Cpu, "CPU");
        });
    }
}

/// A precision in one sentence.
pub(super) const fn about(precision: Precision) -> &'static str {
    match precision {
        Precision::Textbook => "The schoolbook quadratic in f32, with both its cancellations; triangles as in classic.",
        Precision::Classic => "The stable quadratic and Cramer's rule in f32.",
        Precision::Fast => "f32 in its best-conditioned form.",
        Precision::Pair => "The formulas of fast in pairs of f32.",
        Precision::Double => "The formulas of fast in f64.",
        Precision::Exact => "The answer of exact arithmetic, rounded once.",
    }
}

fn camera(ui: &mut Ui, standpoint: &Standpoint, size: [u32; 2]) -> Vec<Act> {
    let camera = &standpoint.camera;
    let mut acts = Vec::new();
    ui.horizontal_wrapped(|ui| {
        if ui.button("Frame").on_hover_text("Back to where the scene is seen from at first (F)").clicked() {
            acts.push(Act::Frame);
        }
        if ui.button("Copy").on_hover_text("As the table [camera] of a scene file (C)").clicked() {
            acts.push(Act::copy_camera(camera));
        }
    });
    acts.extend(distance(ui, standpoint.decades));
    let numbers = |v: glam::Vec3| v.to_array().map(short).join(", ");
    let (eye, target, fov) = (numbers(camera.eye), numbers(camera.target), short(camera.fov_y));
    let text = format!("eye {eye}\ntarget {target}\nfield of view {fov}°");
    ui.label(RichText::new(text).weak().size(11.0));
    let shared = navigate::pixels_a_ray(camera, size);
    if shared >= 1.5 {
        let color = ui.visuals().warn_fg_color;
        let many = if shared.is_finite() { format!("some {shared:.0}") } else { "all".to_owned() };
        let text = format!(
            "The zoom is beyond f32: {many} neighbouring pixels share one ray, whatever the precision. \
             Blocks and stripes are the rays', not the precision's."
        );
        ui.colored_label(color, text);
    }
    acts
}

/// Walking away from whatever is shown, by powers of ten of its size.
pub(super) fn distance(ui: &mut Ui, mut decades: f64) -> Option<Act> {
    let why = "Walks away along an axis, in multiples of the scene's size; the zoom keeps its size in the picture.";
    let moved = ui.horizontal(|ui| {
        let label = ui.label("distance");
        let slider = Slider::new(&mut decades, 0.0..=8.0).custom_formatter(|x, _| format!("10^{x:.1}"));
        ui.add(slider).labelled_by(label.id).on_hover_text(why).changed()
    });
    moved.inner.then_some(Act::WalkAway(decades))
}
