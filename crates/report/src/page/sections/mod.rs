//! What the page says, in order: the same for HTML and Markdown.

mod evidence;
mod families;
mod summary;

pub(crate) use evidence::{against, arithmetic, invariants, leaks, peers, rules, scenes};
pub(crate) use families::{family, matrix};
pub(crate) use summary::{points, summary};

use super::format::count;
use super::table::Table;
use crate::model::Report;

/// A part of the page.
pub(crate) struct Section {
    pub(crate) title: String,
    pub(crate) text: Vec<String>,
    pub(crate) table: Option<Table>,
    pub(crate) after: Vec<String>,
}

impl Section {
    fn new(title: &str, text: &[&str], table: Table) -> Self {
        let text = text.iter().map(|t| (*t).to_owned()).collect();
        Self { title: title.to_owned(), text, table: Some(table), after: Vec::new() }
    }
}

/// Device `i` of a report.
pub(crate) fn device(report: &Report, i: usize) -> &str {
    report.devices.get(i).map_or("?", |d| d.name.as_str())
}

fn who(report: &Report, method: &str, i: usize) -> String {
    format!("{method} on {}", device(report, i))
}

/// What was measured, on what.
pub(crate) fn lead(report: &Report) -> Vec<String> {
    let devices: Vec<String> = report.devices.iter().map(|d| format!("{} ({})", d.name, d.driver)).collect();
    let o = &report.oracles;
    let oracles = if o.disagreed == 0 {
        format!(
            "Two independent oracles, rationals and floating-point expansions, answered {} of these rays and \
            agree on every bit",
            count(o.compared)
        )
    } else {
        format!("Two independent oracles DISAGREE on {} of {} rays", count(o.disagreed), count(o.compared))
    };
    let beyond = if o.beyond == 0 {
        String::new()
    } else {
        format!("; for {} the numbers are too far apart for expansions, and the rationals stand alone", count(o.beyond))
    };
    vec![
        format!(
            "Every error on this page is against the exact answer for the very f32 numbers given, in real \
            arithmetic; every \
             time was taken in the same run, in turn. Measured on {}, with {}, on {}: a {} report of rayproof \
             {}, seed {}.",
            devices.join(" and "),
            report.processor,
            report.date,
            report.mode,
            report.rayproof,
            report.seed
        ),
        format!("{oracles}{beyond}."),
    ]
}

/// Definitions.
pub(crate) fn reading() -> Section {
    let text = [
        "ULP: the distance between t and the exact t in units of the last place of the exact one; u and v \
        likewise. 0.5 is what rounding to the nearest \
         costs, and no f32 can do better.",
        "Misclassified: a hit that is missed, a miss that is hit, or another primitive than the exact closest one.",
        "≤: with 95 % confidence the true share is no larger (Clopper and Pearson, one-sided); none of N means \
        below about 3/N.",
        "Of condition: the error of t over what a rounding of every input may do to it. A few: the method is as \
        good as its input; \
         thousands: it is the method that loses digits.",
        "Residual: what is left of the primitive's equation at the returned t, relative to its size, evaluated \
        in f64. Gap: between e + t d and the point that u and v name.",
        "Margin: the exact distance of the ray's line from the silhouette or edge in units of 2^-24 of the \
        largest coordinate: beyond a few, a wrong verdict is the method's.",
        "A case is a scene and a ray in hexadecimal floats; rayproof intersect answers it again to the bit.",
    ];
    let text = text.map(str::to_owned).into();
    Section { title: "How to read this".to_owned(), text, table: None, after: Vec::new() }
}
