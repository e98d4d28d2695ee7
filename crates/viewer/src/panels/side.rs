//! The panel on the right.

use egui::{ScrollArea, Ui};

use super::{gallery, help, inspector, plot};
use crate::app::App;
use crate::settings::Side;

pub(super) fn show(app: &mut App, ui: &mut Ui, side: Side) {
    // Numbers are not broken over lines; words are.
    let area = if side == Side::Inspector { ScrollArea::both() } else { ScrollArea::vertical() };
    area.id_salt(side as u8).auto_shrink(false).show(ui, |ui| match side {
        Side::Inspector => inspector::show(app, ui),
        Side::Gallery => gallery::show(app, ui),
        Side::Plot => plot::show(app, ui),
        Side::Help => help::show(ui),
    });
}
