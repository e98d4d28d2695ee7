//! The hard cases, one family after the other.

use egui::{RichText, ScrollArea, Ui};
use rayproof::Precision;
use rayproof::scene::FlatHit;
use rayproof_oracle::judge::ulp_distance;
use rayproof_picture::shade::Verdict;

use super::view;
use super::words::{counted, list, many};
use crate::app::App;
use crate::gallery::Hung;
use crate::inspector::Picked;
use crate::model::gallery::{Answered, all};

/// The methods in the table of rays; `pair` is left out, as its errors are mostly those of `double`.
const SHOWN: [Precision; 4] = [Precision::Textbook, Precision::Classic, Precision::Fast, Precision::Double];

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ui.heading("Hard cases");
    ui.label("42 families of scenes and rays that break intersectors, each in its own way.");
    let hung = app.gallery.hung.as_ref().map(|hung| (hung.family, hung.number, hung.of));
    let (family, number, of) = hung.unwrap_or((0, 0, 1));
    let mut wanted = None;
    ui.horizontal(|ui| {
        if ui.button("< family").on_hover_text("The family before").clicked() {
            wanted = Some((family.checked_sub(1).unwrap_or(all().len() - 1), 0));
        }
        if ui.button("family >").on_hover_text("The next family").clicked() {
            wanted = Some((hung.map_or(0, |_| (family + 1) % all().len()), 0));
        }
        if ui.add_enabled(hung.is_some() && number > 0, egui::Button::new("< scene")).clicked() {
            wanted = Some((family, number - 1));
        }
        if ui.add_enabled(hung.is_some() && number + 1 < of, egui::Button::new("scene >")).clicked() {
            wanted = Some((family, number + 1));
        }
    });
    let name = |i: usize| format!("{} {}", all()[i].number, all()[i].name);
    let selected = hung.map_or_else(|| "choose one".to_owned(), |_| name(family));
    list(ui, "family", &selected, |ui| {
        for (i, entry) in all().iter().enumerate() {
            let label = ui.selectable_label(hung.is_some() && i == family, name(i));
            if label.on_hover_text(entry.stresses).clicked() {
                wanted = Some((i, 0));
            }
        }
    });
    if let Some((family, number)) = wanted {
        app.gallery.open(ui.ctx(), &app.device, family, number);
    }
    if hung.is_some() {
        ui.add_space(4.0);
        ui.label(RichText::new(all()[family].stresses).strong());
        let primitives = counted(app.world.scene.len(), "primitive");
        ui.label(format!("Scene {} of {of}: {primitives}, seen from where its first ray starts.", number + 1));
        ui.scope(|ui| rays(app, ui));
    }
    ui.add_space(8.0);
    ui.heading("Distance");
    ui.label(
        "Walk away from the scene: the zoom keeps its size, and single precision does not keep its digits. \
         Choose the mode error and the method textbook, then fast, then exact.",
    );
    ui.push_id("gallery", |ui| view::distance(app, ui));
}

/// The rays that the family aims, and how far each method is off.
fn rays(app: &mut App, ui: &mut Ui) {
    ui.add_space(4.0);
    ui.label("The rays that it aims, with each method's error in ULP. Click one to read its calculation.");
    ui.label(
        RichText::new(
            "miss? is a miss where there is a hit, hit? the reverse, other? another primitive; a dot is a right miss.",
        )
        .weak(),
    );
    // Columns stay columns in a narrow panel: it scrolls.
    ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
    let head = SHOWN.map(|precision| format!("{:>8}", short_name(precision))).concat();
    ui.label(RichText::new(format!("{:>3} {:>12}{head}", "ray", "exact t")).monospace());
    let Some(Hung { rays, .. }) = &app.gallery.hung else { return };
    let mut picked = None;
    let height = ui.text_style_height(&egui::TextStyle::Monospace);
    ScrollArea::vertical().id_salt("rays").max_height((ui.available_height() - 130.0).clamp(160.0, 800.0)).show_rows(
        ui,
        height,
        rays.len(),
        |ui, shown| {
            for i in shown {
                let ray = &rays[i];
                let chosen = app.inspector.picked.as_ref().is_some_and(|p| p.ray == ray.ray && p.pixel.is_none());
                let text = RichText::new(row(i, ray)).monospace();
                if ui.selectable_label(chosen, text).clicked() {
                    picked = Some(ray.ray);
                }
            }
        },
    );
    if let Some(ray) = picked {
        app.settings.side = Some(crate::settings::Side::Inspector);
        app.inspector.pick(ui.ctx(), &app.world, Picked { ray, pixel: None }, None);
    }
}

/// A name that fits its column.
const fn short_name(precision: Precision) -> &'static str {
    match precision {
        Precision::Textbook => "textbk.",
        other => other.name(),
    }
}

fn row(i: usize, ray: &Answered) -> String {
    let exact = ray.hits[5];
    let t = if exact.is_hit() { format!("{:.5e}", exact.t) } else { "miss".to_owned() };
    let place = |precision| Precision::ALL.iter().position(|&p| p == precision).unwrap_or(0);
    let errors = SHOWN.map(|precision| format!("{:>8}", error(&exact, &ray.hits[place(precision)])));
    format!("{i:>3} {t:>12}{}", errors.concat())
}

/// The error of an answer in a word.
fn error(exact: &FlatHit, hit: &FlatHit) -> String {
    match Verdict::of(exact, hit) {
        Verdict::Miss => "·".to_owned(),
        Verdict::Hit => many(ulp_distance(exact.t, hit.t)),
        Verdict::FalseHit => "hit?".to_owned(),
        Verdict::FalseMiss => "miss?".to_owned(),
        Verdict::Another => "other?".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_words_where_the_answer_is_wrong() {
        let hit = FlatHit { t: 1.0, u: 0.0, v: 0.0, primitive: 3 };
        let off = FlatHit { t: f32::from_bits(1.0_f32.to_bits() + 5), ..hit };
        let words = [
            (hit, off),
            (hit, FlatHit { primitive: 4, ..hit }),
            (hit, FlatHit::MISS),
            (FlatHit::MISS, hit),
            (FlatHit::MISS, FlatHit::MISS),
        ];
        assert_eq!(words.map(|(exact, hit)| error(&exact, &hit)), ["5", "other?", "miss?", "hit?", "·"]);
    }
}
