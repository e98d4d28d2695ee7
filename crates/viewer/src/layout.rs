//! Where the panels are, and what each is given.

use egui::{CentralPanel, Frame, Panel as Edge, ScrollArea, Ui};

use crate::act::Act;
use crate::app::App;
use crate::panels::{help, view};
use crate::settings::Panel;

/// The least width of the panel on the right, in points.
const MIN_RIGHT: f32 = 220.0;

impl App {
    /// Shows all panels; what one wants is done before the next is shown.
    pub(crate) fn lay_out(&mut self, ui: &mut Ui) {
        let context = ui.ctx().clone();
        let acts = Edge::top("toolbar").show(ui, |ui| self.toolbar.show(ui, self.settings.panel, &self.opener)).inner;
        self.apply(&context, acts);

        let opening = self.opener.is_busy() || self.gallery.is_busy();
        Edge::bottom("status")
            .show(ui, |ui| self.status.show(ui, &self.canvas, &self.standpoint.world, &self.device, opening));

        let left = Edge::left("view").default_size(220.0).min_size(180.0);
        let last = self.inspector.picked.as_ref().and_then(|picked| picked.pixel);
        let acts = left
            .show(ui, |ui| view::show(ui, &self.settings, !self.device.is_cpu(), &self.standpoint, &self.canvas, last));
        self.apply(&context, acts.inner);

        if let Some(panel) = self.settings.panel {
            // Half of what is left belongs to the picture.
            let most = (ui.available_width() * 0.6).max(MIN_RIGHT);
            // A narrow window has a width of its own: the one it leaves no room for is not forgotten.
            let right = Edge::right(("side", most < 420.0)).default_size(420.0).min_size(MIN_RIGHT).max_size(most);
            let acts = right.show(ui, |ui| self.right(ui, panel)).inner;
            self.apply(&context, acts);
        }
        let center = CentralPanel::no_frame().frame(Frame::NONE);
        let acts = center.show(ui, |ui| self.canvas.show(ui, &self.settings, &self.standpoint, &self.inspector)).inner;
        self.apply(&context, acts);
    }

    /// The panel on the right.
    fn right(&mut self, ui: &mut Ui, panel: Panel) -> Vec<Act> {
        // Numbers are not broken over lines; words are.
        let area = if panel == Panel::Inspector { ScrollArea::both() } else { ScrollArea::vertical() };
        let shown = area.id_salt(panel as u8).auto_shrink(false).show(ui, |ui| match panel {
            Panel::Inspector => self.inspector.show(ui, &self.standpoint.world, self.settings.look.left.precision),
            Panel::Gallery => self.gallery.show(ui, &self.standpoint, self.inspector.picked.as_ref()),
            Panel::Plot => {
                self.plot.show(ui);
                Vec::new()
            }
            Panel::Help => {
                help::show(ui);
                Vec::new()
            }
        });
        shown.inner
    }
}
