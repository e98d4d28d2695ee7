//! What is shown, by which methods, and from where.

use egui::{ComboBox, Context, RichText, ScrollArea, Slider, Ui};
use rayproof::Precision;

use crate::app::App;
use crate::model::look::{Mode, Place, Source};
use crate::model::navigate;
use crate::model::paint::{Errors, Figures};
use crate::panels::legend;

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.heading("Show");
        modes(app, ui);
        ui.add_space(6.0);
        ui.heading("Method");
        methods(app, ui);
        ui.add_space(6.0);
        ui.heading("Figures");
        figures(app, ui);
        ui.add_space(6.0);
        ui.heading("Camera");
        camera(app, ui);
    });
}

fn modes(app: &mut App, ui: &mut Ui) {
    let look = &mut app.settings.look;
    ui.columns(2, |columns| {
        for (i, mode) in Mode::ALL.into_iter().enumerate() {
            let column = &mut columns[usize::from(i >= Mode::ALL.len().div_ceil(2))];
            column.radio_value(&mut look.mode, mode, mode.name()).on_hover_text(format!(
                "{} ({})",
                mode.explains(),
                i + 1
            ));
        }
    });
    ui.label(RichText::new(look.mode.explains()).weak());
}

fn methods(app: &mut App, ui: &mut Ui) {
    let has_device = !app.device.is_cpu();
    let look = &mut app.settings.look;
    if look.mode == Mode::Tier {
        ui.label("The cascade of the precision exact.");
        return;
    }
    let differs = look.mode == Mode::Difference;
    choice(ui, if differs { "this method" } else { "method" }, &mut look.left, has_device);
    if differs {
        choice(ui, "that method", &mut look.right, has_device);
        return;
    }
    ui.checkbox(&mut look.split, "split the picture").on_hover_text("Between two methods (X)");
    if look.split {
        choice(ui, "right of the split", &mut look.right, has_device);
        ui.add(Slider::new(&mut app.settings.split_at, 0.0..=1.0).text("split at").show_value(false));
    }
}

/// Picks a method and, where there is a device, the place where it runs.
fn choice(ui: &mut Ui, label: &str, source: &mut Source, has_device: bool) {
    ComboBox::from_label(label).selected_text(source.precision.name()).show_ui(ui, |ui| {
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

fn figures(app: &App, ui: &mut Ui) {
    let (figures, progress, size) = {
        let picture = app.tracer.picture();
        (picture.figures.clone(), picture.progress.clone(), picture.size)
    };
    let pixels = size[0] as usize * size[1] as usize;
    let look = &app.settings.look;
    let names = [look.left, look.right].map(|source| source.precision.name());
    for (figures, name) in figures.iter().zip(names) {
        match figures {
            None => {}
            Some(Figures::Hits(hits)) => {
                ui.label(format!("{name}: {} of {} pixels hit", grouped(*hits), grouped(pixels)));
            }
            Some(Figures::Tiers(counts)) => {
                for (tier, count) in legend::TIERS.into_iter().zip(counts) {
                    ui.label(format!("{tier}: {} pixels", grouped(*count)));
                }
            }
            Some(Figures::Errors(errors)) => {
                let name = if look.mode == Mode::Difference { names.join(" against ") } else { name.to_owned() };
                errors_of(ui, &name, errors, pixels);
            }
        }
    }
    if let (true, Some([judged, of])) = (look.mode.judges(), progress.judged) {
        let told = format!(
            "The oracle has judged {} of {} pixels: {} contradict the precision exact.",
            grouped(judged),
            grouped(of),
            grouped(progress.contradicted)
        );
        ui.label(RichText::new(told).weak());
        ui.add(egui::ProgressBar::new(judged as f32 / of.max(1) as f32).desired_height(6.0));
    }
}

fn errors_of(ui: &mut Ui, name: &str, errors: &Errors, pixels: usize) {
    ui.label(RichText::new(name).strong());
    ui.label(format!("{} of {} pixels wrong", grouped(errors.wrong()), grouped(pixels)));
    if let Some([median, most, worst]) = errors.ulps {
        ui.label(format!("t off by {} ULP (median), {} (99.9 %), {} (worst)", many(median), many(most), many(worst)));
    }
}

fn camera(app: &mut App, ui: &mut Ui) {
    let context = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        if ui.button("Frame").on_hover_text("Back to where the scene is seen from at first (F)").clicked() {
            app.camera = app.world.camera;
            app.gallery.decades = 0.0;
        }
        if ui.button("Copy").on_hover_text("As the table [camera] of a scene file (C)").clicked() {
            copy_camera(app, &context);
        }
    });
    let mut decades = app.gallery.decades;
    let slider = Slider::new(&mut decades, 0.0..=8.0).text("distance").custom_formatter(|x, _| format!("10^{x:.1}"));
    let why = "Walks away along an axis, in multiples of the scene's size; the zoom keeps its size in the picture.";
    if ui.add(slider).on_hover_text(why).changed() {
        app.gallery.decades = decades;
        app.camera = navigate::walk_away(&app.camera, &app.world.scene, decades);
    }
    let camera = &app.camera;
    let numbers = |v: glam::Vec3| v.to_array().map(|x| format!("{x:.4}")).join(", ");
    ui.label(
        RichText::new(format!(
            "eye {}\ntarget {}\nfield of view {}°",
            numbers(camera.eye),
            numbers(camera.target),
            camera.fov_y
        ))
        .weak()
        .size(11.0),
    );
}

/// Copies the camera as the table of a scene file.
pub(crate) fn copy_camera(app: &mut App, context: &Context) {
    context.copy_text(app.camera.table());
    app.tell(context, "copied the camera as a [camera] table");
}

/// A whole number with its thousands apart.
pub(super) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let first = digits.len() % 3;
    let groups = digits.as_bytes()[first..].chunks(3).map(String::from_utf8_lossy);
    let head = (first > 0).then(|| digits[..first].into());
    head.into_iter().chain(groups).collect::<Vec<_>>().join(",")
}

/// A number of ULP, which may be beyond counting.
pub(super) fn many(ulps: u64) -> String {
    match ulps {
        0..1_000_000 => grouped(usize::try_from(ulps).unwrap_or(usize::MAX)),
        _ => format!("{:.1e}", ulps as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(
            [0, 12, 999, 1000, 123_456, 1_234_567].map(grouped),
            ["0", "12", "999", "1,000", "123,456", "1,234,567"]
        );
        assert_eq!([many(1234), many(2_500_000)], ["1,234", "2.5e6"]);
    }
}
