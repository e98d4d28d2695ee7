//! What runs, and how fast.

use egui::{Context, ProgressBar, RichText, Sides, Spinner, Ui};
use rayproof::scene::Kind;
use rayproof::{Device, Precision};

use super::canvas::Canvas;
use super::words::counted;
use crate::model::view::{Progress, State};
use crate::model::world::World;
use crate::pulse::Pulse;

/// The line at the bottom.
#[derive(Default)]
pub(crate) struct Status {
    /// Something to tell, and until when.
    notice: Option<(String, f64)>,
    pulse: Pulse,
}

impl Status {
    /// Notes that a frame begins; `work` is how long the last one has taken, in seconds.
    pub(crate) fn beat(&mut self, context: &Context, work: Option<f32>) {
        self.pulse.beat(context, work);
        if self.notice.as_ref().is_some_and(|(_, until)| context.input(|i| i.time) > *until) {
            self.notice = None;
        }
    }

    /// Tells something for some seconds.
    pub(crate) fn tell(&mut self, context: &Context, what: impl Into<String>) {
        self.notice = Some((what.into(), context.input(|i| i.time) + 6.0));
        context.request_repaint_after(std::time::Duration::from_secs(6));
    }

    /// Shows how far the picture of a scene is, or that one is being opened; and what traces.
    pub(crate) fn show(&self, ui: &mut Ui, canvas: &Canvas, world: &World, device: &Device, opening: bool) {
        // What traces is always read; the rest is cut where there is no room.
        Sides::new().shrink_left().truncate().show(
            ui,
            |ui| {
                if let Some((notice, _)) = &self.notice {
                    ui.label(RichText::new(notice).strong());
                    return;
                }
                if opening {
                    ui.add(Spinner::new().size(12.0));
                    ui.label("opening");
                }
                doing(ui, &canvas.progress, canvas.size);
                ui.separator();
                ui.label(RichText::new(&world.name).strong());
                ui.label(Kind::ALL.map(|kind| counted(world.scene.count(kind), kind.name())).join(", "));
            },
            |ui| runs(ui, device, &self.pulse),
        );
    }
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
fn runs(ui: &mut Ui, device: &Device, pulse: &Pulse) {
    let info = device.info(Precision::Exact);
    let notes = info.notes.join("\n");
    let label = ui.label(&info.name);
    let hover = format!("Traces: {}\nDriver: {}\n{notes}", info.name, info.driver);
    label.on_hover_text(hover.trim());
    if let (Some(rate), Some([median, most])) = (pulse.rate(), pulse.milliseconds()) {
        ui.separator();
        ui.label(format!("{rate:.0} frames/s"))
            .on_hover_text(format!("Work in a frame: {median:.1} ms (median), {most:.1} ms (95 %)"));
    }
}
