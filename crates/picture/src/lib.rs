//! From hits to colours: what a pixel shows, the same on the command line and in the viewer.
//!
//! [`shade`] has a function for each thing that can be shown; [`color`] the scales that they use, all of which people who
//! see fewer colours can tell apart.
//!
//! ```
//! use rayproof_picture::{color, shade};
//! use rayproof_scene::FlatHit;
//!
//! let hit = FlatHit { t: 1.0, u: 0.0, v: 1.0, primitive: 0 };
//! assert_eq!(shade::by_uv(&hit), [0, 0, 255]);
//! assert_eq!(shade::by_uv(&FlatHit::MISS), color::BACKGROUND);
//! ```
//!
#![doc = include_str!("../README.md")]

pub mod color;
#[cfg(test)]
mod seen;
pub mod shade;
