//! What is kept from one run to the next.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::model::look::Look;

/// What is kept from one run to the next.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    pub(crate) scene: Option<PathBuf>,
    pub(crate) look: Look,
    /// The panel on the right, where one is open.
    #[serde(alias = "side")]
    pub(crate) panel: Option<Panel>,
    /// Where the split is, from 0 at the left to 1.
    pub(crate) split_at: f32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { scene: None, look: Look::default(), panel: Some(Panel::Inspector), split_at: 0.5 }
    }
}

/// A panel on the right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Panel {
    /// One ray, and its calculation.
    Inspector,
    /// The hard cases.
    Gallery,
    /// Speed against error.
    Plot,
    /// Keys.
    Help,
}

const KEY: &str = "rayproof-viewer";

impl Settings {
    /// Those of the last run.
    pub(crate) fn kept(storage: &dyn eframe::Storage) -> Option<Self> {
        eframe::get_value(storage, KEY)
    }

    /// Keeps them for the next.
    pub(crate) fn keep(&self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, KEY, self);
    }
}
