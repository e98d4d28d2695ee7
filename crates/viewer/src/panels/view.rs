//! What is shown, by which methods, and from where.

use egui::{Context, RichText, ScrollArea, Slider, Ui};
use rayproof::Precision;

use super::figures;
use super::words::{list, short};
use crate::app::App;
use crate::model::look::{Mode, Place, Source};
use crate::model::navigate;

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // Each part has its own identity: a slider is held on to when parts above it come and go.
        for (title, part) in [
            ("Show", modes as fn(&mut App, &mut Ui)),
            ("Method", methods),
            ("Camera", camera),
            ("Figures", figures::show),
        ] {
            ui.push_id(title, |ui| {
                ui.heading(title);
                part(app, ui);
                ui.add_space(6.0);
            });
        }
    });
}

fn modes(app: &mut App, ui: &mut Ui) {
    let look = &mut app.settings.look;
    ui.columns(2, |columns| {
        for (i, mode) in Mode::ALL.into_iter().enumerate() {
            let column = &mut columns[usize::from(i >= Mode::ALL.len().div_ceil(2))];
            let explained = format!("{} ({})", mode.explains(), i + 1);
            column.radio_value(&mut look.mode, mode, mode.name()).on_hover_text(explained);
        }
    });
    ui.label(RichText::new(look.mode.explains()).weak());
}

fn methods(app: &mut App, ui: &mut Ui) {
    let has_device = !app.device.is_cpu();
    let look = &mut app.settings.look;
    if look.mode == Mode::Stage {
        ui.label("The cascade of the precision exact.");
        return;
    }
    let differs = look.mode == Mode::Difference;
    choice(ui, "method", &mut look.left, has_device);
    if differs {
        choice(ui, "against", &mut look.right, has_device);
        return;
    }
    ui.checkbox(&mut look.split, "split the picture").on_hover_text("Between two methods (X)");
    if look.split {
        choice(ui, "right of the split", &mut look.right, has_device);
        ui.horizontal(|ui| {
            let label = ui.label("split at");
            let slider = Slider::new(&mut app.settings.split_at, 0.0..=1.0).show_value(false);
            ui.add(slider).labelled_by(label.id);
        });
    }
}

/// Picks a method and, where there is a device, the place where it runs.
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

/// A method in one sentence.
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

fn camera(app: &mut App, ui: &mut Ui) {
    let context = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        if ui.button("Frame").on_hover_text("Back to where the scene is seen from at first (F)").clicked() {
            app.frame();
        }
        if ui.button("Copy").on_hover_text("As the table [camera] of a scene file (C)").clicked() {
            copy_camera(app, &context);
        }
    });
    distance(app, ui);
    let camera = &app.camera;
    let numbers = |v: glam::Vec3| v.to_array().map(short).join(", ");
    let (eye, target, fov) = (numbers(camera.eye), numbers(camera.target), short(camera.fov_y));
    let text = format!("eye {eye}\ntarget {target}\nfield of view {fov}°");
    ui.label(RichText::new(text).weak().size(11.0));
    let shared = navigate::pixels_a_ray(camera, app.canvas.size);
    if shared >= 1.5 {
        let color = ui.visuals().warn_fg_color;
        let many = if shared.is_finite() { format!("some {shared:.0}") } else { "all".to_owned() };
        let text = format!(
            "The zoom is beyond f32: {many} neighbouring pixels share one ray, whatever the method. \
             Blocks and stripes are the rays', not the method's."
        );
        ui.colored_label(color, text);
    }
}

/// Walking away from whatever is shown.
pub(super) fn distance(app: &mut App, ui: &mut Ui) {
    let mut decades = app.gallery.decades;
    let why = "Walks away along an axis, in multiples of the scene's size; the zoom keeps its size in the picture.";
    let moved = ui.horizontal(|ui| {
        let label = ui.label("distance");
        let slider = Slider::new(&mut decades, 0.0..=8.0).custom_formatter(|x, _| format!("10^{x:.1}"));
        ui.add(slider).labelled_by(label.id).on_hover_text(why).changed()
    });
    if moved.inner {
        app.gallery.decades = decades;
        app.camera = navigate::walk_away(&app.camera, &app.world.scene, decades);
    }
}

/// Copies the camera as the table of a scene file.
pub(crate) fn copy_camera(app: &mut App, context: &Context) {
    context.copy_text(app.camera.table());
    app.tell(context, "copied the camera as a [camera] table");
}
