//! The scene of a command, and what is to be said of it.

use std::path::Path;

use rayproof::files::{self, LoadedScene, Origin, Rounding};

use crate::args::Place;
use crate::choices::OnRounding;
use crate::exit::{Code, Failure};
use crate::summary::grouped;

/// Of a scene's size: a coordinate that rounding moves by more is told, or refused.
const HARMLESS: f64 = 1e-6;

/// A scene, and the notes on it.
pub(crate) struct Loaded {
    pub(crate) scene: LoadedScene,
    pub(crate) notes: Vec<String>,
    /// The longest side of its box.
    size: f64,
}

impl Loaded {
    /// Reads a scene.
    ///
    /// # Errors
    /// When it is bad, or when rounding moves it more than it may.
    pub(crate) fn read(path: &Path, place: &Place) -> Result<Self, Failure> {
        let scene = files::load_at(path, place.origin.unwrap_or_default())?;
        let size = scene.scene.bounds().map_or(0.0, |[low, high]| f64::from((high - low).max_element()));
        let mut notes: Vec<String> = scene.notes.iter().map(ToString::to_string).collect();
        if scene.scene.is_empty() {
            notes.push(format!("{}: the scene holds nothing to hit", path.display()));
        }
        if scene.origin != [0.0; 3] {
            let [x, y, z] = scene.origin;
            notes.push(format!("the origin {x},{y},{z} is subtracted from the scene and its rays"));
        }
        let mut loaded = Self { scene, notes, size };
        if let Some(told) = loaded.told(path, loaded.scene.rounding, place) {
            match place.rounding {
                OnRounding::Warn => loaded.notes.push(told),
                OnRounding::Error => return Err(Failure::new(Code::BadInput, told)),
                OnRounding::Allow => {}
            }
        }
        Ok(loaded)
    }

    /// By how much rounding may move a place without a word. Where nothing can be hit, no ray is moved off anything.
    pub(crate) fn harmless(&self) -> f64 {
        if self.scene.scene.is_empty() { f64::INFINITY } else { HARMLESS * self.size }
    }

    /// What rounding did, where it did harm, and what to do.
    pub(crate) fn told(&self, path: &Path, rounding: Rounding, place: &Place) -> Option<String> {
        let Rounding { largest_shift: shift, flattened_triangles: flat, .. } = rounding;
        if shift <= self.harmless() && flat == 0 {
            return None;
        }
        let mut text = format!("{}: rounding to f32 moved a place by {shift:.2e}", path.display());
        if self.size > 0.0 {
            text += &format!(", {:.1e} of the scene's size", shift / self.size);
        }
        match flat {
            0 => {}
            1 => text += ", and 1 triangle lost its area",
            n => text += &format!(", and {} triangles lost their area", grouped(n)),
        }
        text += match place.origin {
            Some(Origin::Auto) => "; no origin mends it: --rounding allow says nothing of it",
            _ => "; give --origin auto, or --rounding allow",
        };
        Some(text)
    }
}
