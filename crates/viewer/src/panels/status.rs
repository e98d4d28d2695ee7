//! What runs, and how fast.

use egui::{ProgressBar, RichText, Sides, Spinner, Ui};
use rayproof::Precision;
use rayproof::scene::Kind;

use super::words::counted;
use crate::app::App;
use crate::model::view::{Progress, State};

pub(super) fn show(app: &App, ui: &mut Ui) {
    let (progress, size) = {
        let picture = app.tracer.picture();
        (picture.progress.clone(), picture.size)
    };
    // What traces is always read; the rest is cut where there is no room.
    Sides::new().shrink_left().truncate().show(
        ui,
        |ui| {
            if let Some((notice, _)) = &app.notice {
                ui.label(RichText::new(notice).strong());
                return;
            }
            if app.opening.is_some() || app.gallery.is_opening() {
                ui.add(Spinner::new().size(12.0));
                ui.label("opening");
            }
            doing(ui, &progress, size);
            let scene = &app.world.scene;
            ui.separator();
            ui.label(RichText::new(&app.world.name).strong());
            ui.label(Kind::ALL.map(|kind| counted(scene.count(kind), kind.name())).join(", "));
        },
        |ui| device(app, ui),
    );
}

/// How far the picture is.
fn doing(ui: &mut Ui, progress: &Progress, [width, height]: [u32; 2]) {
    match &progress.state {
        State::Idle => {}
        State::Building(source) => {
            ui.add(Spinner::new().size(12.0));
            ui.label(format!("building the tree for {}", source.precision.name()));
        }
        State::Tracing => {
            #[expect(clippy::cast_possible_truncation, reason = "a share")]
            ui.add(ProgressBar::new(progress.traced as f32).desired_width(80.0).desired_height(8.0));
            ui.label("tracing");
        }
        State::Judging => {
            ui.add(Spinner::new().size(12.0));
            ui.label("the oracle judges");
        }
        State::Done => {
            ui.label(format!("{width} × {height}, done"));
        }
        State::Failed(why) => {
            ui.colored_label(ui.visuals().error_fg_color, why);
        }
    }
    if progress.rate > 0.0 {
        let seconds = |s: Option<f64>| s.map_or_else(|| "–".to_owned(), |s| format!("{:.0} ms", s * 1e3));
        ui.label(format!("{:.1} M rays/s", progress.rate / 1e6)).on_hover_text(format!(
            "From the last move: first picture after {}, whole after {}",
            seconds(progress.first),
            seconds(progress.whole)
        ));
    }
}

/// What traces, and how often the window is painted.
fn device(app: &App, ui: &mut Ui) {
    let info = app.device.info(Precision::Exact);
    let notes = info.notes.join("\n");
    let label = ui.label(&info.name);
    let hover = format!("Traces: {}\nDriver: {}\n{notes}", info.name, info.driver);
    label.on_hover_text(hover.trim());
    if let (Some(rate), Some([median, most])) = (app.pulse.rate(), app.pulse.milliseconds()) {
        ui.separator();
        ui.label(format!("{rate:.0} frames/s"))
            .on_hover_text(format!("Work in a frame: {median:.1} ms (median), {most:.1} ms (95 %)"));
    }
}
