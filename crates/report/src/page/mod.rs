//! The pages made of reports. Each is a function of the model alone: every number on them is in `report.json`.

mod curves;
mod format;
mod html;
mod markdown;
mod pareto;
mod sections;
mod svg;
mod table;
#[cfg(test)]
mod tests;

pub use format::count;

use crate::model::Report;

/// The page: one file of HTML with its plots, for reading offline or on paper. The first report is shown first; the
/// devices of all
/// stand side by side in the plot.
#[must_use]
pub fn html(reports: &[Report]) -> String {
    html::html(reports)
}

/// The tables in Markdown.
#[must_use]
pub fn markdown(reports: &[Report]) -> String {
    markdown::markdown(reports)
}

/// The plot of speed against error as an SVG file, with the devices of all reports.
#[must_use]
pub fn plot(reports: &[Report]) -> String {
    pareto::plot(reports, pareto::Speed::Test)
}
