//! Speed against error of all methods, on the view that is shown.

use egui::{Color32, Grid, RichText, Ui};
use egui_plot::{Line, Plot, PlotPoint, PlotPoints, Points, Text};
use rayproof::Precision;

use super::view::{grouped, many};
use crate::app::App;
use crate::model::measure::Measured;

/// Okabe and Ito's colours, one a method.
const COLORS: [Color32; 6] = [
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 114, 178),
];

/// Where no error at all is drawn, on the logarithmic axis.
const NONE: f64 = -1.0;

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ui.heading("Speed against error");
    ui.label("On the rays of this view: the time of a ray, and the error of t that 99.9 % of the hits stay within. Left and down is better.");
    match &app.measured {
        Some((_, Ok(measured))) => {
            plot(ui, measured);
            table(ui, measured);
        }
        Some((_, Err(why))) => {
            ui.colored_label(ui.visuals().error_fg_color, why);
        }
        None => {}
    }
    if app.measuring.is_some() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label("measuring");
        });
    }
    if ui.button("Measure again").clicked() {
        app.measured = None;
    }
}

/// The error as it is drawn: the worst of 99.9 %.
fn height(measured: &Measured) -> f64 {
    measured.errors.ulps.map_or(NONE, |[_, most, _]| if most == 0 { NONE } else { (most as f64).log10() })
}

/// A mark of the vertical axis.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a label")]
fn ulps(decades: f64) -> String {
    many(10.0_f64.powf(decades).round() as u64)
}

fn plot(ui: &mut Ui, measured: &[Measured]) {
    let axis = |x: f64| format!("{:.3}", 10.0_f64.powf(x)).trim_end_matches('0').trim_end_matches('.').to_owned();
    Plot::new("speed against error")
        .height(260.0)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .set_margin_fraction(egui::vec2(0.15, 0.15))
        .include_y(NONE)
        .include_y(1.0)
        .x_axis_label("ns a ray")
        .y_axis_label("ULP")
        .x_grid_spacer(egui_plot::uniform_grid_spacer(|_| [1.0, 0.5, 0.25]))
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [2.0, 1.0, 1.0]))
        .x_axis_formatter(move |mark, _| axis(mark.value))
        .y_axis_formatter(move |mark, _| match mark.value {
            y if y <= NONE => "0".to_owned(),
            y if y < 0.0 => String::new(),
            y => ulps(y),
        })
        .show(ui, |plot| {
            for (m, color) in measured.iter().zip(COLORS) {
                let [median, low, high] = m.nanoseconds.map(f64::log10);
                let y = height(m);
                plot.line(Line::new("", vec![[low, y], [high, y]]).color(color).width(2.0));
                let at = PlotPoints::from(vec![[median, y]]);
                plot.points(Points::new(m.precision.name(), at).radius(5.0).color(color));
                let name = RichText::new(m.precision.name()).color(color).strong();
                // Beside each other where they would cover each other.
                let anchor = if m.precision == Precision::Pair {
                    egui::Align2::LEFT_BOTTOM
                } else {
                    egui::Align2::CENTER_BOTTOM
                };
                plot.text(Text::new("", PlotPoint::new(median, y + 0.12), name).anchor(anchor));
            }
        });
}

fn table(ui: &mut Ui, measured: &[Measured]) {
    Grid::new("measured").striped(true).num_columns(5).show(ui, |ui| {
        for head in ["method", "ns a ray", "99.9 %, ULP", "worst", "wrong"] {
            ui.label(RichText::new(head).strong());
        }
        ui.end_row();
        for m in measured {
            ui.label(m.precision.name());
            let [median, low, high] = m.nanoseconds;
            ui.label(format!("{median:.0}")).on_hover_text(format!("from {low:.0} to {high:.0} in five rounds"));
            let [_, most, worst] =
                m.errors.ulps.map_or_else(|| ["–", "–", "–"].map(str::to_owned), |ulps| ulps.map(many));
            ui.label(most);
            ui.label(worst);
            ui.label(grouped(m.errors.wrong()));
            ui.end_row();
        }
    });
    if let Some(first) = measured.first() {
        ui.label(
            RichText::new(format!(
                "{} rays of the picture, five rounds, against the precision exact.",
                grouped(first.rays)
            ))
            .weak(),
        );
    }
}
