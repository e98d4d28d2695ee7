//! Speed against error: what a report holds, and the pages made of it.

pub mod model;
pub mod peers;
