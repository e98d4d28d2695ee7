//! The hard cases, one family after the other.

use egui::{Button, Context, RichText, ScrollArea, Ui};
use rayproof::scene::FlatHit;
use rayproof::{Device, Error, Precision};
use rayproof_oracle::judge::ulp_distance;
use rayproof_picture::shade::Verdict;

use super::inspector::Picked;
use super::view;
use super::words::{counted, list, many};
use crate::act::Act;
use crate::model::gallery::{Answered, Exhibit, all};
use crate::model::task::{Task, take};
use crate::standpoint::Standpoint;

/// The precisions in the table of rays; `pair` is left out, as its errors are mostly those of `double`.
const SHOWN: [Precision; 4] = [Precision::Textbook, Precision::Classic, Precision::Fast, Precision::Double];

/// The exhibit that hangs now, and the one that is being hung.
#[derive(Default)]
pub(crate) struct Gallery {
    opening: Option<Task<Result<Exhibit, Error>>>,
    pub(crate) hung: Option<Exhibit>,
}

impl Gallery {
    /// Hangs a scene of a family.
    pub(crate) fn hang(&mut self, context: &Context, device: &Device, family: usize, scene: usize) {
        let device = device.clone();
        self.opening = Some(Task::start(context, move || Exhibit::open(family, scene, device)));
    }

    /// Takes the exhibit down: another scene is shown.
    pub(crate) fn close(&mut self) {
        self.hung = None;
    }

    pub(crate) const fn is_busy(&self) -> bool {
        self.opening.is_some()
    }

    /// Shows a new exhibit when it is there.
    pub(crate) fn collect(&mut self) -> Option<Act> {
        Some(match take(&mut self.opening)? {
            Ok(Ok(exhibit)) => {
                let world = exhibit.world.clone();
                self.hung = Some(exhibit);
                Act::Enter { world, file: None }
            }
            Ok(Err(error)) => Act::Fault(error.to_string()),
            Err(why) => Act::Fault(why.to_owned()),
        })
    }

    /// Shows the families, and the rays of the exhibit; `picked` is the one that is inspected.
    pub(crate) fn show(&self, ui: &mut Ui, standpoint: &Standpoint, picked: Option<&Picked>) -> Vec<Act> {
        ui.heading("Hard cases");
        ui.label("42 families of scenes and rays that break intersectors, each in its own way.");
        let mut acts = Vec::new();
        acts.extend(step(ui, self.hung.as_ref()));
        acts.extend(choose(ui, self.hung.as_ref()));
        if let Some(exhibit) = &self.hung {
            ui.add_space(4.0);
            ui.label(RichText::new(all()[exhibit.family].stresses).strong());
            let primitives = counted(exhibit.world.scene.len(), "primitive");
            let (number, of) = (exhibit.number + 1, exhibit.of);
            ui.label(format!("Scene {number} of {of}: {primitives}, seen from where its first ray starts."));
            acts.extend(ui.scope(|ui| rays(ui, &exhibit.rays, picked)).inner);
        }
        ui.add_space(8.0);
        ui.heading("Distance");
        ui.label(
            "Walk away from the scene: the zoom keeps its size, and single precision does not keep its digits. \
             Choose the mode error and the precision textbook, then fast, then exact.",
        );
        acts.extend(ui.push_id("gallery", |ui| view::distance(ui, standpoint.decades)).inner);
        acts
    }
}

/// Steps from family to family, and from scene to scene.
fn step(ui: &mut Ui, hung: Option<&Exhibit>) -> Option<Act> {
    let (family, scene, of) = hung.map_or((0, 0, 1), |hung| (hung.family, hung.number, hung.of));
    let last = all().len() - 1;
    let mut wanted = None;
    ui.horizontal(|ui| {
        if ui.button("< family").on_hover_text("The family before").clicked() {
            wanted = Some((family.checked_sub(1).unwrap_or(last), 0));
        }
        if ui.button("family >").on_hover_text("The next family").clicked() {
            wanted = Some((hung.map_or(0, |_| (family + 1) % all().len()), 0));
        }
        if ui.add_enabled(hung.is_some() && scene > 0, Button::new("< scene")).clicked() {
            wanted = Some((family, scene - 1));
        }
        if ui.add_enabled(hung.is_some() && scene + 1 < of, Button::new("scene >")).clicked() {
            wanted = Some((family, scene + 1));
        }
    });
    wanted.map(|(family, scene)| Act::Hang { family, scene })
}

/// Chooses a family by its name.
fn choose(ui: &mut Ui, hung: Option<&Exhibit>) -> Option<Act> {
    let name = |i: usize| format!("{} {}", all()[i].number, all()[i].name);
    let selected = hung.map_or_else(|| "choose one".to_owned(), |hung| name(hung.family));
    let mut wanted = None;
    list(ui, "family", &selected, |ui| {
        for (family, entry) in all().iter().enumerate() {
            let label = ui.selectable_label(hung.is_some_and(|hung| hung.family == family), name(family));
            if label.on_hover_text(entry.stresses).clicked() {
                wanted = Some(Act::Hang { family, scene: 0 });
            }
        }
    });
    wanted
}

/// The rays that the family aims, and how far each precision is off.
fn rays(ui: &mut Ui, rays: &[Answered], picked: Option<&Picked>) -> Option<Act> {
    ui.add_space(4.0);
    ui.label("The rays that it aims, with each precision's error in ULP. Click one to read its calculation.");
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
    let height = ui.text_style_height(&egui::TextStyle::Monospace);
    let most = (ui.available_height() - 130.0).clamp(160.0, 800.0);
    let picked = picked.filter(|picked| picked.pixel.is_none()).map(|picked| picked.ray);
    let mut wanted = None;
    ScrollArea::vertical().id_salt("rays").max_height(most).show_rows(ui, height, rays.len(), |ui, shown| {
        for i in shown {
            let text = RichText::new(row(i, &rays[i])).monospace();
            if ui.selectable_label(picked == Some(rays[i].ray), text).clicked() {
                wanted = Some(Act::Inspect(Picked { ray: rays[i].ray, pixel: None }, None));
            }
        }
    });
    wanted
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
