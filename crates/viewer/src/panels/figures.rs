//! Numbers about the picture.

use egui::{ProgressBar, RichText, Ui};
use rayproof::Precision;
use rayproof_picture::shade::Verdict;

use super::legend;
use super::words::{counted, grouped, many, short};
use crate::app::App;
use crate::model::look::Mode;
use crate::model::paint::{Errors, Figures};

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    let (figures, progress, size, look) = {
        let picture = app.tracer.picture();
        (picture.figures.clone(), picture.progress.clone(), picture.size, picture.look)
    };
    let pixels = size[0] as usize * size[1] as usize;
    let names = [look.left, look.right].map(|source| source.precision.name());
    for (side, (figures, name)) in figures.iter().zip(names).enumerate() {
        match figures {
            None => {}
            Some(Figures::Hits { hits, range }) => {
                ui.label(format!("{name}: {} of {} hit", grouped(*hits), counted(pixels, "pixel")));
                if let (Mode::Depth, Some([near, far])) = (look.mode, range) {
                    ui.label(format!("t from {} to {}", short(*near), short(*far)));
                }
            }
            Some(Figures::Stages(counts)) => {
                for (stage, &count) in legend::STAGES.into_iter().zip(counts) {
                    ui.label(format!("{stage}: {}", counted(count, "pixel")));
                }
            }
            Some(Figures::Errors(errors)) => {
                let name = if look.mode == Mode::Difference { names.join(" against ") } else { name.to_owned() };
                ui.label(RichText::new(name).strong());
                errors_of(ui, look.mode, errors, pixels);
                let by = if side == 0 { look.left.precision } else { look.right.precision };
                ui.push_id(side, |ui| next_wrong(app, ui, errors, size, by));
            }
        }
    }
    if let (true, Some([judged, of])) = (look.mode.judges(), progress.judged) {
        let told = format!(
            "The oracle has judged {} of {}: {} disagree with exact.",
            grouped(judged),
            counted(of, "pixel"),
            grouped(progress.contradicted)
        );
        ui.label(RichText::new(told).weak());
        ui.add(ProgressBar::new(judged as f32 / of.max(1) as f32).desired_height(6.0));
    }
}

fn errors_of(ui: &mut Ui, mode: Mode, errors: &Errors, pixels: usize) {
    let (what, off) = match mode {
        Mode::Difference => ("differ in what they hit", "t apart by"),
        _ => ("hit or miss wrongly", "t of the others off by"),
    };
    ui.label(format!("{} of {} {what}", grouped(errors.wrong()), counted(pixels, "pixel")));
    if mode != Mode::Difference {
        for (verdict, &count) in Verdict::ALL.iter().zip(&errors.verdicts).skip(2).filter(|(_, count)| **count > 0) {
            ui.label(format!("   {}: {}", verdict.name(), grouped(count)));
        }
    }
    if let Some([median, most, worst]) = errors.ulps {
        ui.label(format!("{off} {} ULP (median), {} (99.9 %), {} (worst)", many(median), many(most), many(worst)));
    }
}

/// Goes from one wrong pixel of a method to the next.
fn next_wrong(app: &mut App, ui: &mut Ui, errors: &Errors, size: [u32; 2], by: Precision) {
    if errors.places.is_empty() {
        return;
    }
    let button = ui.button("Inspect the next of these").on_hover_text("They are ringed where they are few");
    if !button.clicked() {
        return;
    }
    let last = app.inspector.picked.as_ref().and_then(|picked| picked.pixel);
    let last = last.map(|[x, y]| y * size[0] + x);
    let after = |place: u32| last.is_none_or(|last| place > last);
    let next = errors.places.iter().find(|(place, _)| after(*place)).unwrap_or(&errors.places[0]).0;
    app.inspector.handed = Some(by);
    super::pick(app, ui.ctx(), size, [next % size[0], next / size[0]]);
}
