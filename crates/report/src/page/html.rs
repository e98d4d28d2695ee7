//! The report as one HTML file: no script, no network.

use std::fmt::Write as _;

use super::format::{escape, number};
use super::pareto::{self, Speed};
use super::sections::{self, Section};
use super::{curves, table};
use crate::model::{Case, Family, Report};

const STYLE: &str = include_str!("page.css");

pub(crate) fn html(reports: &[Report]) -> String {
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Rayproof: speed \
         against error</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>Speed \
         against error</h1>\n"
    );
    let Some(first) = reports.first() else {
        out.push_str("<p>There is no report to show.</p>\n</main>\n</body>\n</html>\n");
        return out;
    };
    paragraphs(&mut out, &sections::lead(first));
    section(&mut out, &sections::summary(reports));
    plots(&mut out, reports);
    section(&mut out, &sections::precisions(first));
    rest(&mut out, first);
    for (k, report) in reports.iter().enumerate().skip(1) {
        let _ = writeln!(out, "<h1>Report {}</h1>", k + 1);
        paragraphs(&mut out, &sections::lead(report));
        rest(&mut out, report);
    }
    section(&mut out, &sections::reading());
    out.push_str("</main>\n</body>\n</html>\n");
    out
}

fn plots(out: &mut String, reports: &[Report]) {
    let first = &reports[0];
    out.push_str("<h2>Speed against error</h2>\n");
    if first.panels.is_empty() {
        out.push_str("<p>Not measured in this report.</p>\n");
        return;
    }
    let note = "A mark is a precision on a device. Above: the error of t that 99.9 % of the hits stay within, and \
    a whisker up to the worst. \
                Below: the share of misclassified rays; where none was, the mark lies on the floor and the \
                whisker reaches the 95 % bound. \
                The grey steps join the points of a device that none of its others beats in both. Left and down is better.";
    paragraphs(out, &[note.to_owned()]);
    figure(out, &pareto::plot(reports, Speed::Test));
    let more = "The same against rays a second: right and down is better. On 64 primitives a tree saves little; \
    whole scenes are below.";
    let _ = writeln!(out, "<details><summary>The same against millions of rays a second</summary>\n<p>{more}</p>");
    figure(out, &pareto::plot(reports, Speed::Rays));
    out.push_str("</details>\n");
}

fn rest(out: &mut String, report: &Report) {
    section(out, &sections::against(report));
    folded(out, &sections::points(report));
    out.push_str("<h2>A sphere that moves away</h2>\n");
    let note = "A sphere of radius 1, rays all over its disc. B² − 4AC cancels as the square of the distance \
    grows, and the stable form of the \
                roots does not help: the digits are gone before. Curves that coincide are drawn over one another.";
    paragraphs(out, &[note.to_owned()]);
    if report.distance.is_empty() {
        out.push_str("<p>Not measured in this report.</p>\n")
    } else {
        figure(out, &curves::distance(report))
    }
    paragraphs(out, &[first_wrong(report)]);
    out.push_str("<h2>How far from the edge verdicts go wrong</h2>\n");
    if report.margins.is_empty() {
        out.push_str("<p>Not measured in this report.</p>\n")
    } else {
        figure(out, &curves::margins(report))
    }
    paragraphs(out, &[largest_wrong(report)]);
    section(out, &sections::matrix(report, 0));
    for family in &report.families {
        details(out, report, family);
    }
    folded(out, &sections::leaks(report));
    folded(out, &sections::invariants(report));
    section(out, &sections::scenes(report));
    section(out, &sections::peers(report));
    section(out, &sections::devices(report));
    section(out, &sections::arithmetic(report));
    section(out, &sections::rules(report));
}

/// From which distance on each precision misclassifies, in words.
fn first_wrong(report: &Report) -> String {
    let on_first = || report.distance.iter().filter(|c| c.device == 0);
    // Where two distances in a row are wrong: a single ray may be anywhere.
    let one = |c: &crate::model::DistanceCurve| {
        let from = c.points.windows(2).find(|w| w.iter().all(|p| p.wrong.count > 0));
        let none = c.points.iter().all(|p| p.wrong.count == 0);
        match from {
            Some(w) => format!("{} from {} radii on", c.precision, number(w[0].distance)),
            None if none => format!("{} nowhere", c.precision),
            None => format!("{} here and there", c.precision),
        }
    };
    let all: Vec<String> = on_first().map(one).collect();
    let Some(point) = on_first().flat_map(|c| &c.points).next() else { return String::new() };
    format!(
        "Of {} rays at each distance, spread over the disc and none of them aimed at its rim, some are misclassified by {}.",
        super::format::count(point.wrong.of),
        all.join(", by ")
    )
}

/// The largest margins of wrong verdicts in words.
fn largest_wrong(report: &Report) -> String {
    let on_first = report.margins.iter().filter(|c| c.device == 0);
    let one = |c: &crate::model::MarginCurve| {
        let far = if c.largest_wrong == 0.0 { "none wrong".to_owned() } else { number(c.largest_wrong) };
        format!("{}, {}: {far}", c.primitive, c.precision)
    };
    let all: Vec<String> = on_first.map(one).collect();
    if all.is_empty() {
        String::new()
    } else {
        format!("The largest margin at which a verdict was wrong: {}.", all.join("; "))
    }
}

fn details(out: &mut String, report: &Report, family: &Family) {
    let _ = writeln!(
        out,
        "<details><summary>{} {}</summary>\n<p>{}</p>",
        family.number,
        escape(&family.name),
        escape(&family.stresses)
    );
    out.push_str(&sections::family(report, family).html());
    for row in family.rows.iter().filter(|row| row.device == 0) {
        for (what, case) in [("worst t", &row.errors.worst), ("first misclassified", &row.errors.first_wrong)] {
            if let Some(case) = case {
                show(out, &row.precision, what, case);
            }
        }
    }
    out.push_str("</details>\n");
}

/// A case as commands to paste.
fn show(out: &mut String, precision: &str, what: &str, case: &Case) {
    let off = case.ulp.map_or(String::new(), |ulp| format!(", off by {} ULP", number(ulp)));
    let replays = if case.replays { "" } else { " (alone it answers otherwise: a larger scene is scaled by its size)" };
    let _ = writeln!(
        out,
        "<p>{precision}, {what}: exact is {}; the answer {}{off}{replays}</p>\n<pre>cat &gt; case.toml \
        &lt;&lt;'END'\n{}END\ncat &gt; case.csv \
         &lt;&lt;'END'\n{}END\nrayproof intersect case.toml case.csv -o - --to csv --device cpu --precision \
         {precision} --check 1</pre>",
        escape(&case.exact),
        escape(&case.answer),
        escape(&case.scene),
        escape(&case.rays)
    );
}

fn figure(out: &mut String, svg: &str) {
    let _ = writeln!(out, "<figure>\n{svg}</figure>");
}

fn paragraphs(out: &mut String, texts: &[String]) {
    for text in texts.iter().filter(|text| !text.is_empty()) {
        let _ = writeln!(out, "<p>{}</p>", escape(text));
    }
}

fn section(out: &mut String, section: &Section) {
    let _ = writeln!(out, "<h2>{}</h2>", escape(&section.title));
    paragraphs(out, &section.text);
    out.push_str(&section.table.as_ref().map(table::Table::html).unwrap_or_default());
    paragraphs(out, &section.after);
}

/// A section whose table is long: closed at first.
fn folded(out: &mut String, section: &Section) {
    let _ = writeln!(out, "<section class=\"folded\">\n<h2>{}</h2>", escape(&section.title));
    paragraphs(out, &section.text);
    out.push_str("<details><summary>Show the table</summary>\n");
    out.push_str(&section.table.as_ref().map(table::Table::html).unwrap_or_default());
    out.push_str("</details>\n");
    paragraphs(out, &section.after);
    out.push_str("</section>\n");
}
