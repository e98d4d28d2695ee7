//! The viewer: see the hits, see the error.
//!
//! [`App`] is the window's content; [`Start`] says what it opens with. The binary `rayproof-viewer` puts it into a window;
//! tests put it into none. Pictures come from the engines that `rayproof intersect` uses, errors from the precision exact and
//! then, pixel after pixel, from the oracle.
//!
//! A panel owns its state, is shown what it reads, and returns what it wants done: an `Act`. Keys, scripts and work that was done
//! beside the window return the same, and `App` does it, in one place.
//!
#![doc = include_str!("../README.md")]

mod act;
mod app;
mod keys;
mod layout;
mod model;
mod motion;
mod opener;
mod panels;
mod pulse;
mod save;
mod script;
mod settings;
mod shown;
mod standpoint;
#[cfg(test)]
mod tests;

pub use app::{App, Start};
pub use model::look::{Look, Mode, Place, Source};
pub use script::{Failure, Script};
pub use settings::Panel;
