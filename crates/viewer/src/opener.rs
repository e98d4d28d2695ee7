//! Opening scenes, beside the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Context;
use rayproof::Device;

use crate::act::Act;
use crate::model::task::{Task, take};
use crate::model::world::World;

/// The endings that can be opened.
const ENDINGS: [&str; 6] = ["obj", "ply", "stl", "gltf", "glb", "toml"];

/// What is said where a dialog gave no file.
const NOTHING: &str = "No file was chosen. Where no dialog opens, type the path, or drop the file here.";

/// A file's scene, or why there is none; no file where none was chosen.
type Opened = Option<(PathBuf, Result<World, String>)>;

/// The scene that is being opened, and why the last one could not be.
#[derive(Default)]
pub(crate) struct Opener {
    task: Option<Task<Opened>>,
    pub(crate) fault: Option<String>,
}

impl Opener {
    /// Reads a scene.
    pub(crate) fn open(&mut self, context: &Context, path: &Path, device: &Device) {
        let (path, device) = (path.to_owned(), device.clone());
        self.task = Some(Task::start(context, move || Some(read(path, device))));
    }

    /// Asks for a file, at first in the folder of the last one, and reads it.
    pub(crate) fn choose(&mut self, context: &Context, last: Option<&Path>, device: &Device) {
        let (device, folder) = (device.clone(), last.and_then(Path::parent).map(Path::to_owned));
        self.task = Some(Task::start(context, move || {
            let mut dialog = rfd::FileDialog::new().add_filter("scenes", &ENDINGS);
            if let Some(folder) = folder {
                dialog = dialog.set_directory(folder);
            }
            dialog.pick_file().map(|path| read(path, device))
        }));
    }

    pub(crate) const fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// What is to be done when a scene is there, or its fault.
    pub(crate) fn collect(&mut self) -> Option<Act> {
        Some(match take(&mut self.task)? {
            Ok(Some((path, Ok(world)))) => Act::Enter { world: Arc::new(world), file: Some(path) },
            Ok(Some((_, Err(why)))) => Act::Fault(why),
            // Nobody is to blame where a dialog was closed, or none could be had.
            Ok(None) => Act::Tell(NOTHING.to_owned()),
            Err(why) => Act::Fault(why.to_owned()),
        })
    }
}

fn read(path: PathBuf, device: Device) -> (PathBuf, Result<World, String>) {
    let world = World::open(&path, device);
    (path, world)
}
