//! Scenes and tables on disk: meshes and scene files in ([`load`]), rays in ([`RayReader`]) and out ([`RayWriter`]), hits out
//! ([`HitWriter`]).
//!
//! What is wrong in a file is an [`Error`] that says what, where and what would be right.

mod error;
pub mod replay;
mod scenes;
mod tables;

pub use error::{BadInput, Error};
pub use scenes::{LoadedScene, load};
pub use tables::{Format, HitKind, HitWriter, INVALID_RAY, InvalidRays, RayReader, RayWriter};
