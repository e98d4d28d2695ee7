//! Speed against error of all precisions, on the view that is shown.

use egui::{Color32, Context, Grid, RichText, Ui};
use egui_plot::{Corner, GridMark, Legend, Line, MarkerShape, PlotPoints, Points};

use super::words::{grouped, many};
use crate::model::measure::{Measured, measure};
use crate::model::task::{Task, take};
use crate::model::view::View;

/// Okabe and Ito's colours, one a precision.
const COLORS: [Color32; 6] = [
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 114, 178),
];

/// And a shape of its own, for eyes that see fewer colours.
const SHAPES: [MarkerShape; 6] = [
    MarkerShape::Cross,
    MarkerShape::Square,
    MarkerShape::Up,
    MarkerShape::Diamond,
    MarkerShape::Down,
    MarkerShape::Circle,
];

/// Where no error at all is drawn, on the logarithmic axis.
const NONE: f64 = -1.0;

/// What was measured, and the number of the view that it was measured on.
type Measurement = (u64, Result<Vec<Measured>, String>);

/// The plot, and what is being measured for it.
#[derive(Default)]
pub(crate) struct Plot {
    measuring: Option<Task<Measurement>>,
    pub(crate) measured: Option<Measurement>,
}

impl Plot {
    /// Whether a view is still to be measured.
    pub(crate) fn wants(&self, number: u64) -> bool {
        self.measuring.is_none() && self.measured.as_ref().is_none_or(|(measured, _)| *measured != number)
    }

    /// Measures all precisions on a view.
    pub(crate) fn measure(&mut self, context: &Context, view: View, number: u64) {
        self.measuring = Some(Task::start(context, move || {
            (number, measure(&view.world, &view.camera, view.size).map_err(|e| e.to_string()))
        }));
    }

    pub(crate) const fn is_measuring(&self) -> bool {
        self.measuring.is_some()
    }

    /// Takes in the measurement when it is there.
    pub(crate) fn collect(&mut self) {
        if let Some(measured) = take(&mut self.measuring) {
            self.measured = Some(measured.unwrap_or_else(|why| (0, Err(why.to_owned()))));
        }
    }

    /// Shows it.
    pub(crate) fn show(&mut self, ui: &mut Ui) {
        ui.heading("Speed against error");
        ui.label("On the rays of this view: the time of a ray, and the error of t that 99.9\u{a0}% of the hits stay within. Left and down is better.");
        match &self.measured {
            Some((_, Ok(measured))) => {
                plot(ui, measured);
                table(ui, measured);
            }
            Some((_, Err(why))) => {
                ui.colored_label(ui.visuals().error_fg_color, why);
            }
            None => {}
        }
        if self.is_measuring() {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label("measuring");
            });
        }
        if ui.button("Measure again").clicked() {
            self.measured = None;
        }
    }
}

/// The error as it is drawn: the worst of 99.9 %; none where nothing is hit.
fn height(measured: &Measured) -> Option<f64> {
    measured.errors.ulps.map(|[_, most, _]| if most == 0 { NONE } else { (most as f64).log10() })
}

/// A mark of an axis, for the logarithm of what it says.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a label")]
fn mark(decades: f64) -> String {
    match 10.0_f64.powf(decades) {
        x if x >= 1.0 => many(x.round() as u64),
        x => format!("{x:.1}"),
    }
}

/// Marks at 1, 2 and 5 of every decade, or at more where that are few.
fn decades(input: egui_plot::GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    // Enough that two at least are within.
    let digits: &[(f64, f64)] = if high - low > 1.5 {
        &[(1.0, 1.0), (2.0, 0.3), (5.0, 0.3)]
    } else {
        &[(1.0, 1.0), (1.5, 1.0), (2.0, 1.0), (3.0, 1.0), (5.0, 1.0), (7.0, 1.0)]
    };
    let mut marks = Vec::new();
    let mut decade = low.floor();
    while decade <= high {
        for &(digit, step_size) in digits {
            let value = decade + digit.log10();
            // Not so near to an end that its label is cut.
            let gap = 0.04 * (high - low);
            if (low + gap..=high - gap).contains(&value) {
                marks.push(GridMark { value, step_size });
            }
        }
        decade += 1.0;
    }
    marks
}

fn plot(ui: &mut Ui, measured: &[Measured]) {
    egui_plot::Plot::new("speed against error")
        .height(280.0)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .set_margin_fraction(egui::vec2(0.2, 0.15))
        .include_y(NONE)
        .include_y(1.0)
        .x_axis_label("ns a ray")
        .y_axis_label("ULP")
        .legend(Legend::default().position(Corner::RightTop))
        .x_grid_spacer(decades)
        .y_grid_spacer(decades)
        .x_axis_formatter(|at, _| mark(at.value))
        .y_axis_formatter(|at, _| match at.value {
            y if (y - NONE).abs() < 1e-9 => "0".to_owned(),
            // Below 1 there is only 0.
            y if y < 0.0 || y.fract().abs() > 1e-9 => String::new(),
            y => mark(y),
        })
        .show(ui, |plot| {
            for ((m, color), shape) in measured.iter().zip(COLORS).zip(SHAPES) {
                let [median, low, high] = m.nanoseconds.map(f64::log10);
                let Some(y) = height(m) else { continue };
                plot.line(Line::new(m.precision.name(), vec![[low, y], [high, y]]).color(color).width(2.0));
                let at = PlotPoints::from(vec![[median, y]]);
                plot.points(Points::new(m.precision.name(), at).shape(shape).radius(6.0).color(color));
            }
        });
    ui.label(RichText::new("A mark is the median of five rounds, its line the fastest and the slowest.").weak());
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a text")]
fn nanoseconds(time: f64) -> String {
    grouped(time.round() as usize)
}

fn table(ui: &mut Ui, measured: &[Measured]) {
    Grid::new("measured").striped(true).num_columns(5).show(ui, |ui| {
        for head in ["precision", "ns a ray", "99.9 %, ULP", "worst", "wrong"] {
            ui.label(RichText::new(head).strong());
        }
        ui.end_row();
        for m in measured {
            ui.label(m.precision.name());
            let [median, low, high] = m.nanoseconds;
            ui.label(nanoseconds(median)).on_hover_text(format!(
                "from {} to {} in five rounds",
                nanoseconds(low),
                nanoseconds(high)
            ));
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
