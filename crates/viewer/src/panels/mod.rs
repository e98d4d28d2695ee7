//! The parts of the window.

mod calculation;
mod figures;
mod gallery;
mod help;
mod inspector;
mod legend;
mod picture;
mod plot;
mod side;
mod status;
pub(crate) mod toolbar;
pub(crate) mod view;
mod words;

pub(crate) use picture::pick;

use egui::{CentralPanel, Frame, Panel, Ui};

use crate::app::App;

/// The least width of the panel on the right, in points.
const MIN_SIDE: f32 = 220.0;

/// Lays out the window.
pub(crate) fn show(app: &mut App, ui: &mut Ui) {
    Panel::top("toolbar").show(ui, |ui| toolbar::show(app, ui));
    Panel::bottom("status").show(ui, |ui| status::show(app, ui));
    Panel::left("view").default_size(220.0).min_size(180.0).show(ui, |ui| view::show(app, ui));
    if let Some(side) = app.settings.side {
        // Half of what is left belongs to the picture.
        let most = (ui.available_width() * 0.6).max(MIN_SIDE);
        // A narrow window has a width of its own: the one it leaves no room for is not forgotten.
        let panel = Panel::right(("side", most < 420.0)).default_size(420.0).min_size(MIN_SIDE).max_size(most);
        panel.show(ui, |ui| side::show(app, ui, side));
    }
    CentralPanel::no_frame().frame(Frame::NONE).show(ui, |ui| picture::show(app, ui));
}
