//! What the page says, in order: the same for HTML and Markdown.

mod evidence;
mod families;
mod summary;

pub(crate) use evidence::{against, arithmetic, devices, invariants, leaks, peers, rules, scenes};
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

/// The name of device `i` where several reports are shown: those after the first are numbered.
pub(crate) fn labelled(report: &Report, k: usize, i: usize) -> String {
    let name = device(report, i);
    if k == 0 { name.to_owned() } else { format!("{name} [report {}]", k + 1) }
}

/// What the precisions are.
pub(crate) fn precisions(report: &Report) -> Section {
    let mut table = Table::new(3, ["precision", "on spheres", "on triangles"]);
    for m in &report.precisions {
        let triangle = if m.triangle.is_empty() { "as classic" } else { &m.triangle };
        table.row([m.id.clone(), m.sphere.clone(), triangle.to_owned()]);
    }
    Section::new("The precisions", &["By the words that --precision takes."], table)
}

/// A sentence where times spread widely: the machine was busy.
fn busy(report: &Report) -> String {
    let points = report.panels.iter().flat_map(|p| &p.points).flat_map(|p| [p.ns, p.mrays]);
    let all: Vec<crate::model::Timing> =
        points.chain(report.scenes.iter().flat_map(|s| &s.rows).map(|r| r.mrays)).collect();
    let spread = all.iter().filter(|t| t.p95 > 1.5 * t.p5).count();
    if spread * 10 < all.len() {
        return String::new();
    }
    format!(
        "Beware of the times: {spread} of {} spread by half and more between their 5th and 95th percentile. The machine was \
         busy; run it again when it is not.",
        all.len()
    )
}

fn who(report: &Report, precision: &str, i: usize) -> String {
    format!("{precision} on {}", device(report, i))
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
        busy(report),
    ]
}

/// Definitions.
pub(crate) fn reading() -> Section {
    let text = [
        "ULP: the distance between t and the exact t in units of the last place of the exact one, over the hits whose \
         primitive is right; u and v likewise. 0.5 is what rounding to the nearest costs, and no f32 can do better. An \
         infinite t counts as 2^128. (--check counts the f32 numbers in between instead, which is the same but for errors \
         of half the number and more.)",
        "Quantiles: the smallest value that so many of the hits do not exceed; with fewer than a thousand hits the 99.9 % \
         are the worst.",
        "Misclassified: a hit that is missed, a miss that is hit, or another primitive than the exact closest one.",
        "≤: with 95 % confidence the true share is no larger (Clopper and Pearson, one-sided); none of N means below about \
         3/N.",
        "Of condition: the error of t over what a rounding of every input and of the result may do to it. A few: the precision \
         is as good as its input; thousands: it is the precision that loses digits. Rays along the surface, which have no \
         such bound, are left out.",
        "Residual: what is left of the primitive's equation at the returned t, relative to its size, evaluated in f64. Gap: \
         between e + t d and the point that u and v name, over the triangle's size.",
        "Margin: the exact distance of the ray's line from the silhouette or edge in units of 2^-24 of the largest \
         coordinate: beyond a few, a wrong verdict is the precision's.",
        "Times: medians with the 5th and 95th percentile, everything run in turn after a warm-up that compiles. By the device's own \
         clock (kernel) and from the first ray handed over to the last hit back (end to end); the CPU engine has only the latter.",
        "A case is a scene and a ray in hexadecimal floats; rayproof intersect answers it again to the bit.",
    ];
    let text = text.map(str::to_owned).into();
    Section { title: "How to read this".to_owned(), text, table: None, after: Vec::new() }
}
