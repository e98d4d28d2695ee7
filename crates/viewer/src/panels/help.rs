//! The keys, and how to read what is shown.

use egui::{RichText, Ui};
use rayproof::Precision;

use super::view::about;
use crate::keys::HELP;
use crate::model::look::Mode;

pub(crate) fn show(ui: &mut Ui) {
    ui.heading("Keys and pointer");
    for (keys, does) in HELP {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(keys).strong());
            ui.label(does);
        });
    }
    ui.add_space(8.0);
    ui.heading("What pixels show");
    for mode in Mode::ALL {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(mode.name()).strong());
            ui.label(mode.explains());
        });
    }
    ui.add_space(8.0);
    ui.heading("Precisions");
    for precision in Precision::ALL {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(precision.name()).strong());
            ui.label(about(precision));
        });
    }
    ui.add_space(8.0);
    ui.heading("ULP");
    ui.label(
        "A unit in the last place is the gap between a number and the next one that f32 has. \
         An error of 0 ULP is the exact answer rounded once; at 10 ULP the last digit or two are lost, \
         at 10,000 ULP some four of the seven digits.",
    );
}
