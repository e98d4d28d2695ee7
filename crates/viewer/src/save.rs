//! Pictures to files: of the scene, and of the window.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;

use egui::{ColorImage, Context};
use image::ExtendedColorType::Rgb8;
use image::ImageEncoder as _;
use image::codecs::png::PngEncoder;

use crate::act::Act;
use crate::model::task::{Task, take};

/// What is to be saved, and what is on its way.
#[derive(Default)]
pub(crate) struct Saver {
    /// Whether the picture is to be saved as soon as it is whole.
    pub(crate) waits: bool,
    /// A picture of the window on its way to a file; and what is told of it then.
    writing: Option<Task<String>>,
}

impl Saver {
    /// Writes a picture of the window into a new file of the working folder, as soon as there is one.
    pub(crate) fn window(&mut self, context: &Context, scene: &str) {
        let (sender, receiver) = channel::<([u32; 2], Vec<u8>)>();
        let scene = scene.to_owned();
        self.writing = Some(Task::start(context, move || match receiver.recv() {
            Ok((size, pixels)) => write_new(&scene, "window", size, &pixels),
            Err(_) => "the window gave no picture of itself".to_owned(),
        }));
        context.request_screenshot(move |image| {
            let _ = sender.send(rgb(&image));
        });
    }

    /// What is to be told when the window's picture is written.
    pub(crate) fn collect(&mut self) -> Option<Act> {
        Some(Act::Tell(take(&mut self.writing)?.unwrap_or_else(str::to_owned)))
    }
}

/// The size of an image, and its red, green and blue.
pub(crate) fn rgb(image: &ColorImage) -> ([u32; 2], Vec<u8>) {
    let pixels = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    (image.size.map(|side| u32::try_from(side).unwrap_or(0)), pixels)
}

/// Writes a PNG under a name that is not taken, made of a scene's name and a word; returned is what to tell of it.
pub(crate) fn write_new(scene: &str, word: &str, size: [u32; 2], rgb: &[u8]) -> String {
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
