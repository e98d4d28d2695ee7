//! What each precision answers about a ray, over the whole scene.

use egui::{Grid, RichText, Ui};
use rayproof::Precision;
use rayproof::scene::{FlatHit, Scene, number};
use rayproof_oracle::judge::ulp_distance;
use rayproof_oracle::worked::Value;
use rayproof_picture::shade::Verdict;

use super::calculation::marked;
use super::{address, mono, strong};
use crate::model::inspection::Inspection;
use crate::panels::words::many;

/// Shows the answers, and the oracle's.
pub(super) fn show(ui: &mut Ui, scene: &Scene, inspection: &Inspection) {
    strong(ui, "Answers");
    let truth = &inspection.truth;
    Grid::new("answers").num_columns(4).striped(true).show(ui, |ui| {
        let heads = [
            ("precision", "How t was computed"),
            ("primitive", "geometry / primitive, as in the files of hits"),
            ("t", "Where on the ray, in multiples of its direction"),
            ("ULP off", "How many f32 numbers lie between this t and the exact one, rounded once"),
        ];
        for (head, explained) in heads {
            ui.label(RichText::new(head).weak()).on_hover_text(explained);
        }
        ui.end_row();
        let named = Precision::ALL.map(Precision::name).into_iter().zip(&inspection.hits);
        for (name, hit) in named.chain([("oracle", truth)]) {
            ui.label(name);
            if hit.is_hit() {
                mono(ui, address(scene, hit.primitive));
                let [exact, shown] = [truth.t, hit.t].map(Value::F32);
                let hex = format!("t = {}\nu = {:?}\nv = {:?}", number::hex(hit.t), hit.u, hit.v);
                ui.label(marked(ui, &shown, &exact, 9)).on_hover_text(hex);
            } else {
                ui.label("miss");
                ui.label("");
            }
            ui.label(off(truth, hit));
            ui.end_row();
        }
    });
}

fn off(truth: &FlatHit, hit: &FlatHit) -> String {
    match Verdict::of(truth, hit) {
        Verdict::Miss => String::new(),
        Verdict::Hit => many(ulp_distance(truth.t, hit.t)),
        wrong => wrong.name().to_owned(),
    }
}
