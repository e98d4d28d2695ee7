//! stand-in until the page is merged
use crate::model::Report;
/// h
pub fn html(_: &[Report]) -> String {
    String::new()
}
/// m
pub fn markdown(_: &[Report]) -> String {
    String::new()
}
/// p
pub fn plot(_: &Report) -> String {
    String::new()
}
