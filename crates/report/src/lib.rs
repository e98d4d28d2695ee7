//! Speed against error: every precision on every device, measured against exact arithmetic, and the pages made of it.
//!
//! [`measure()`] takes the figures, [`model::Report`] holds them, and is what `report.json` says.
//!
#![doc = include_str!("../README.md")]

pub mod measure;
pub mod model;
pub mod page;
pub mod peers;

pub use measure::measure;
