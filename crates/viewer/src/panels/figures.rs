//! Numbers about the picture.

use egui::{ProgressBar, RichText, Ui};
use rayproof::scene::Camera;
use rayproof_picture::shade::Verdict;

use super::canvas::Canvas;
use super::inspector::Picked;
use super::legend;
use super::words::{counted, grouped, many, short};
use crate::act::Act;
use crate::model::look::Mode;
use crate::model::paint::{Errors, Figures};

/// Shows them; where pixels are wrong, a button inspects the one after `last`.
pub(super) fn show(ui: &mut Ui, canvas: &Canvas, camera: &Camera, last: Option<[u32; 2]>) -> Option<Act> {
    let Canvas { figures, progress, size, look, .. } = canvas;
    let pixels = size[0] as usize * size[1] as usize;
    let mut act = None;
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
                let next = ui.push_id(side, |ui| next_wrong(ui, errors, *size, last)).inner;
                act = act.or(next.map(|pixel| Act::Inspect(Picked::through(camera, *size, pixel), Some(by))));
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
    act
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

/// Goes from one wrong pixel to the next.
fn next_wrong(ui: &mut Ui, errors: &Errors, [width, _]: [u32; 2], last: Option<[u32; 2]>) -> Option<[u32; 2]> {
    let first = errors.places.first()?;
    let button = ui.button("Inspect the next of these").on_hover_text("They are ringed where they are few");
    if !button.clicked() {
        return None;
    }
    let last = last.map(|[x, y]| y * width + x);
    let after = |place: u32| last.is_none_or(|last| place > last);
    let next = errors.places.iter().find(|(place, _)| after(*place)).unwrap_or(first).0;
    Some([next % width, next / width])
}
