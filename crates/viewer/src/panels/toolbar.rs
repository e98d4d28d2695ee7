//! Opening scenes, saving pictures, choosing panels.

use std::path::PathBuf;

use egui::{ComboBox, Key, ScrollArea, TextEdit, ThemePreference, Ui};

use crate::act::Act;
use crate::opener::Opener;
use crate::settings::Panel;

/// The bar at the top.
#[derive(Default)]
pub(crate) struct Toolbar {
    /// What the user has typed for a path.
    path: String,
}

impl Toolbar {
    /// Shows it, beside the panel that is open on the right, and what went wrong with a scene.
    pub(crate) fn show(&mut self, ui: &mut Ui, open: Option<Panel>, opener: &Opener) -> Vec<Act> {
        let mut acts = Vec::new();
        ui.horizontal_wrapped(|ui| {
            let what = "A mesh (.obj .ply .stl .gltf .glb) or a scene file (.toml)";
            if ui.button("Open…").on_hover_text(what).clicked() {
                acts.push(Act::Choose);
            }
            acts.extend(self.typed(ui));
            let how = "As PNG, without the window around it (P)";
            if ui.button("Save picture").on_hover_text(how).clicked() {
                acts.push(Act::SavePicture);
            }
            ui.separator();
            acts.extend(panels(ui, open));
            ui.separator();
            theme(ui);
        });
        if let Some(fault) = &opener.fault {
            ui.separator();
            ui.horizontal_wrapped(|ui| {
                ui.colored_label(ui.visuals().error_fg_color, "This scene could not be opened.");
                if ui.button("Dismiss").clicked() {
                    acts.push(Act::Dismiss);
                }
            });
            ScrollArea::vertical().max_height(120.0).show(ui, |ui| ui.label(fault));
        }
        acts
    }

    /// A path to be typed.
    fn typed(&mut self, ui: &mut Ui) -> Option<Act> {
        let label = ui.label("or path");
        let typed = TextEdit::singleline(&mut self.path).hint_text("bunny.ply").desired_width(160.0);
        let field = ui.add(typed).labelled_by(label.id);
        let path = self.path.trim();
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) && !path.is_empty();
        entered.then(|| Act::Open(PathBuf::from(path)))
    }
}

/// The panels of the right.
fn panels(ui: &mut Ui, open: Option<Panel>) -> Vec<Act> {
    let names =
        [(Panel::Inspector, "Inspector"), (Panel::Gallery, "Gallery"), (Panel::Plot, "Plot"), (Panel::Help, "Help")];
    let mut acts = Vec::new();
    for (panel, name) in names {
        let is_open = open == Some(panel);
        let mut label = ui.selectable_label(is_open, name);
        if is_open {
            label = label.on_hover_text("Click again to close it");
        }
        if label.clicked() {
            acts.push(Act::Toggle(panel));
        }
    }
    acts
}

/// Light, dark, or as the system is.
fn theme(ui: &mut Ui) {
    let mut theme = ui.ctx().options(|options| options.theme_preference);
    let names =
        [(ThemePreference::System, "system"), (ThemePreference::Light, "light"), (ThemePreference::Dark, "dark")];
    let name = names.iter().find(|(value, _)| *value == theme).map_or("", |(_, name)| name);
    let label = ui.label("theme");
    let list = ComboBox::from_id_salt("theme").width(60.0).selected_text(name);
    let list = list.show_ui(ui, |ui| {
        for (value, name) in names {
            ui.selectable_value(&mut theme, value, name);
        }
    });
    list.response.labelled_by(label.id);
    ui.ctx().set_theme(theme);
}
