//! Scenes and tables on disk: meshes and scene files in ([`load`]), rays in ([`RayReader`]) and out ([`RayWriter`]), hits out
//! ([`HitWriter`]).
//!
//! What is wrong in a file is an [`Error`] that says what, where and what would be right.
//!
#![doc = include_str!("../README.md")]

mod decimal;
mod error;
mod gzip;
mod note;
mod quote;
pub mod replay;
mod scenes;
mod survey;
mod tables;

pub use error::{BadInput, Error};
pub use note::{Note, Rounding};
pub use scenes::{LoadedScene, Origin, load, load_at};
pub use survey::{Survey, Tally};
// What a reader is told to do with bad rays.
pub use rayproof_scene::{INVALID_RAY, InvalidRays};
pub use tables::{Format, HitKind, HitWriter, Kept, KeptColumns, RayReader, RayWriter};
