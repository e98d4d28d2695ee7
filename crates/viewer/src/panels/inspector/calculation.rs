//! The quantities of one ray and one primitive, by every precision; digits that are wrong are marked.

use egui::text::LayoutJob;
use egui::{Color32, FontId, Grid, RichText, TextFormat, Ui};
use rayproof::Precision;
use rayproof_oracle::worked::{COLUMNS, Conclusion, EXACT, Row, System, Value, Worked};

use super::{mono, strong};

/// Digits that tell an f32, and an f64, from its neighbours; and those of the exact value.
const DIGITS: [usize; 5] = [9, 9, 9, 17, 20];

pub(super) fn show(ui: &mut Ui, worked: &Worked) {
    strong(ui, "Calculation");
    ui.label(RichText::new("Where a number is not the nearest there is to the exact one, the digits that differ are red and underlined. \
             ULP are counted from the exact value, unrounded.").weak());
    if let Some(systems) = &worked.systems {
        system(ui, systems);
    }
    for row in &worked.rows {
        quantity(ui, row);
    }
    strong(ui, "Each precision concludes: t, rounded to f32");
    let alone = "For this primitive alone. In a scene the tree rules out primitives whose box the ray misses, and with them \
                 some false hits; and fast, double and exact scale by powers of two, which matters only where a number \
                 over- or underflows here.";
    ui.label(RichText::new(alone).weak());
    Grid::new("conclusions").num_columns(2).striped(true).show(ui, |ui| {
        for (precision, answer) in COLUMNS.into_iter().zip(&worked.answers) {
            ui.label(precision.name());
            match answer {
                Conclusion::Absent => ui.label("– (no formula of its own)"),
                Conclusion::Miss(why) => ui.label(format!("miss: {why}")),
                Conclusion::Hit { t, .. } => {
                    // The exact one too is rounded in an answer: only that can be compared with the others.
                    let t = if let Value::Exact(root) = t { Value::F32(root.to_f32()) } else { t.clone() };
                    // Where there is no hit, no digit of one is right.
                    let exact = Value::F32(exact_t(worked).unwrap_or(f32::NAN));
                    ui.label(marked(ui, &t, &exact, DIGITS[0]))
                }
            };
            ui.end_row();
        }
    });
}

/// The exact t, rounded once.
fn exact_t(worked: &Worked) -> Option<f32> {
    match &worked.answers[EXACT] {
        Conclusion::Hit { t: Value::Exact(root), .. } => Some(root.to_f32()),
        _ => None,
    }
}

/// The equations of a triangle in f32, the entries that are rounded marked.
fn system(ui: &mut Ui, systems: &[System; 5]) {
    ui.label("[b - a, c - a, -d] (u, v, t) = e - a, a row for x, y and z, in f32:");
    let [shown, exact] = [1, EXACT].map(|column| &systems[column]);
    Grid::new("system").num_columns(5).show(ui, |ui| {
        for (shown, exact) in shown.iter().zip(exact) {
            for (column, (shown, exact)) in shown.iter().zip(exact).enumerate() {
                if column == 3 {
                    ui.label("=");
                }
                ui.label(marked(ui, shown, exact, 5)).on_hover_text(format!("exactly {}", exact.decimal(20)));
            }
            ui.end_row();
        }
    });
}

/// One quantity: its value by each precision, one under the other, so that digits line up.
fn quantity(ui: &mut Ui, row: &Row) {
    ui.add_space(4.0);
    let exact = &row.values[EXACT];
    let rounded = |value: &&Value| value.ulps_from(exact).is_none_or(|ulps| ulps != 0.0);
    let present = || row.values[..EXACT].iter().filter(|value| !matches!(value, Value::Absent));
    let all_exact = present().count() > 0 && !present().any(|value| rounded(&value));
    ui.horizontal(|ui| {
        ui.label(RichText::new(row.name).strong().monospace());
        ui.label(RichText::new(format!("= {}", row.formula)).weak());
        if all_exact {
            mono(ui, exact.decimal(DIGITS[0]));
            ui.label(RichText::new("exact by every precision").weak());
        }
    });
    if all_exact {
        return;
    }
    Grid::new(("quantity", row.name)).num_columns(3).min_row_height(0.0).spacing([8.0, 0.0]).show(ui, |ui| {
        for ((precision, value), digits) in COLUMNS.into_iter().zip(&row.values).zip(DIGITS) {
            if matches!(value, Value::Absent) {
                continue;
            }
            ui.label(RichText::new(precision.name()).size(11.0));
            let label = ui.label(marked(ui, value, exact, digits));
            if let Some(hex) = value.hex() {
                label.on_hover_text(hex);
            }
            let off = value.ulps_from(exact).filter(|_| precision != Precision::Exact);
            let off = off.map_or_else(String::new, |ulps| {
                if ulps == 0.0 { "exact".to_owned() } else { format!("{} ULP", short(ulps)) }
            });
            ui.label(RichText::new(off).size(11.0).weak());
            ui.end_row();
        }
    });
}

/// A number of ULP that need not be whole.
fn short(ulps: f64) -> String {
    match ulps {
        x if x >= 1e6 => format!("{x:.1e}"),
        x if x >= 10.0 => format!("{x:.0}"),
        x => format!("{x:.2}"),
    }
}

/// A value in decimal; digits that are not those of the exact one are marked, by more than colour.
pub(super) fn marked(ui: &Ui, value: &Value, exact: &Value, digits: usize) -> LayoutJob {
    let text = value.decimal(digits);
    // The nearest number that the format has is as right as can be, whatever its digits.
    let nearest = value.ulps_from(exact).is_some_and(|ulps| ulps <= 0.5);
    let same = if nearest || matches!(exact, Value::Absent) { text.len() } else { value.same_digits(exact, digits) };
    let font = FontId::monospace(egui::TextStyle::Monospace.resolve(ui.style()).size);
    let wrong = if ui.visuals().dark_mode { Color32::from_rgb(255, 130, 110) } else { Color32::from_rgb(180, 20, 20) };
    let plain = TextFormat::simple(font.clone(), ui.visuals().text_color());
    let mark = TextFormat { underline: egui::Stroke::new(1.0, wrong), ..TextFormat::simple(font, wrong) };
    let mut job = LayoutJob::default();
    // The exponent is marked only where it is not the same.
    let (mantissa, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    let (good, bad) = mantissa.split_at(same.min(mantissa.len()));
    let exponent_differs = same == 0;
    job.append(good, 0.0, plain.clone());
    job.append(bad, 0.0, mark.clone());
    job.append(exponent, 0.0, if exponent_differs { mark } else { plain });
    job
}
