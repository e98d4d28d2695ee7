//! Opening scenes, saving pictures.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;

use egui::{ColorImage, ComboBox, Context, ThemePreference, Ui};
use image::ExtendedColorType::Rgb8;
use image::ImageEncoder as _;
use image::codecs::png::PngEncoder;

use crate::app::App;
use crate::model::task::Task;
use crate::model::world::World;
use crate::settings::Side;

/// The endings that can be opened.
const ENDINGS: [&str; 6] = ["obj", "ply", "stl", "gltf", "glb", "toml"];

pub(super) fn show(app: &mut App, ui: &mut Ui) {
    ui.horizontal_wrapped(|ui| {
        if ui.button("Open…").on_hover_text("A mesh (.obj .ply .stl .gltf .glb) or a scene file (.toml)").clicked() {
            choose(app, ui.ctx());
        }
        let label = ui.label("or path");
        let typed = egui::TextEdit::singleline(&mut app.path).hint_text("bunny.ply").desired_width(160.0);
        let field = ui.add(typed).labelled_by(label.id);
        if field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) && !app.path.trim().is_empty() {
            let path = PathBuf::from(app.path.trim());
            app.open(ui.ctx(), &path);
        }
        if ui.button("Save picture").on_hover_text("As PNG, without the window around it (P)").clicked() {
            // Not before it is whole.
            app.saving = true;
        }
        ui.separator();
        for (side, name) in
            [(Side::Inspector, "Inspector"), (Side::Gallery, "Gallery"), (Side::Plot, "Plot"), (Side::Help, "Help")]
        {
            let open = app.settings.side == Some(side);
            let mut label = ui.selectable_label(open, name);
            if open {
                label = label.on_hover_text("Click again to close it");
            }
            if label.clicked() {
                app.settings.side = Some(side).filter(|_| !open);
            }
        }
        ui.separator();
        theme(ui);
    });
    if let Some(fault) = app.fault.clone() {
        ui.separator();
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(ui.visuals().error_fg_color, "This scene could not be opened.");
            if ui.button("Dismiss").clicked() {
                app.fault = None;
            }
        });
        egui::ScrollArea::vertical().max_height(120.0).show(ui, |ui| ui.label(fault));
    }
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

/// Asks for a file, beside the window.
fn choose(app: &mut App, context: &Context) {
    let (device, start) = (app.device.clone(), app.settings.scene.clone());
    app.opening = Some(Task::start(context, move || {
        let mut dialog = rfd::FileDialog::new().add_filter("scenes", &ENDINGS);
        if let Some(folder) = start.as_deref().and_then(Path::parent) {
            dialog = dialog.set_directory(folder);
        }
        match dialog.pick_file() {
            Some(path) => {
                let world = World::open(&path, device);
                (path, world)
            }
            // Nothing chosen; or no dialog to be had.
            None => (PathBuf::new(), Err(NOTHING.to_owned())),
        }
    }));
}

/// What is said where a dialog gave no file.
pub(crate) const NOTHING: &str = "No file was chosen. Where no dialog opens, type the path, or drop the file here.";

/// Writes the picture into a new file of the working folder.
pub(crate) fn save_picture(app: &mut App, context: &Context) {
    let (size, pixels) = {
        let picture = app.tracer.picture();
        (picture.size, app.composed(&picture))
    };
    let told = write_new(&app.world.name, app.settings.look.mode.name(), size, pixels.as_flattened());
    app.tell(context, told);
}

/// Writes a picture of the window into a new file of the working folder, as soon as there is one.
pub(crate) fn save_window(app: &mut App, context: &Context) {
    let (sender, receiver) = channel::<([u32; 2], Vec<u8>)>();
    let name = app.world.name.clone();
    app.writing = Some(Task::start(context, move || match receiver.recv() {
        Ok((size, pixels)) => write_new(&name, "window", size, &pixels),
        Err(_) => "the window gave no picture of itself".to_owned(),
    }));
    context.request_screenshot(move |image| {
        let _ = sender.send(rgb(&image));
    });
}

/// The size of an image, and its red, green and blue.
pub(crate) fn rgb(image: &ColorImage) -> ([u32; 2], Vec<u8>) {
    let pixels = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    (image.size.map(|side| u32::try_from(side).unwrap_or(0)), pixels)
}

/// Writes a PNG under a name that is not taken, made of a scene's name and a word; returned is what to tell of it.
fn write_new(scene: &str, word: &str, size: [u32; 2], rgb: &[u8]) -> String {
    // The names of hard cases are sentences.
    let stem = Path::new(scene).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.filter(|stem| !stem.contains([' ', ':', ','])).unwrap_or_else(|| "picture".to_owned());
    let names = (1..10_000).map(|n| PathBuf::from(format!("{stem}-{word}-{n}.png")));
    let Some(path) = names.into_iter().find(|path| !path.exists()) else {
        return format!("there are ten thousand pictures {stem}-{word} here already");
    };
    match write_png(&path, size, rgb) {
        Ok(()) => format!("saved {}", std::path::absolute(&path).unwrap_or(path).display()),
        Err(why) => format!("{}: {why}", path.display()),
    }
}

/// Writes red, green and blue as a PNG.
///
/// # Errors
/// When the file cannot be written.
pub(crate) fn write_png(path: &Path, [width, height]: [u32; 2], rgb: &[u8]) -> Result<(), String> {
    let file = File::create(path).map_err(|e| e.to_string())?;
    PngEncoder::new(BufWriter::new(file)).write_image(rgb, width, height, Rgb8).map_err(|e| e.to_string())
}
