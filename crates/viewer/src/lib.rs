//! The viewer: see the hits, see the error.
//!
//! [`App`] is the window's content; [`Start`] says what it opens with. The binary `rayproof-viewer` puts it into a window;
//! tests put it into none. Pictures come from the engines that `rayproof intersect` uses, errors from the precision exact and
//! then, pixel after pixel, from the oracle.

mod app;
mod canvas;
mod gallery;
mod inspector;
mod keys;
mod model;
mod motion;
mod panels;
mod pulse;
mod script;
mod settings;
mod shown;
#[cfg(test)]
mod tests;

pub use app::{App, Start};
pub use model::look::{Look, Mode, Place, Source};
pub use script::{Failure, Panel, Script};
