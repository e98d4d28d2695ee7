//! The parts of the window. Each owns its state, is given what it reads, and returns what it wants done.

pub(crate) mod canvas;
mod figures;
pub(crate) mod gallery;
pub(crate) mod help;
pub(crate) mod inspector;
mod legend;
mod marks;
mod picture;
pub(crate) mod plot;
pub(crate) mod status;
pub(crate) mod toolbar;
pub(crate) mod view;
mod words;
