//! The report as Markdown: its tables.

use std::fmt::Write as _;

use super::sections::{self, Section};
use crate::model::Report;

pub(crate) fn markdown(reports: &[Report]) -> String {
    let mut out =
        "# Speed against error\n\nThe page with its plots and the cases to replay is report.html; every number is in report.json.\n".to_owned();
    section(&mut out, &sections::summary(reports));
    for (k, report) in reports.iter().enumerate() {
        let _ = write!(out, "\n# Report {}\n", k + 1);
        for text in sections::lead(report).iter().filter(|text| !text.is_empty()) {
            let _ = write!(out, "\n{text}\n");
        }
        for part in [sections::precisions, sections::against, sections::points] {
            section(&mut out, &part(report));
        }
        section(&mut out, &sections::matrix(report, 0));
        for part in [
            sections::leaks,
            sections::invariants,
            sections::scenes,
            sections::peers,
            sections::devices,
            sections::arithmetic,
            sections::rules,
        ] {
            section(&mut out, &part(report));
        }
    }
    section(&mut out, &sections::reading());
    out
}

fn section(out: &mut String, section: &Section) {
    let _ = write!(out, "\n## {}\n", section.title);
    for text in &section.text {
        let _ = write!(out, "\n{text}\n");
    }
    if let Some(table) = &section.table {
        let _ = write!(out, "\n{}", table.markdown());
    }
    for text in section.after.iter().filter(|text| !text.is_empty()) {
        let _ = write!(out, "\n{text}\n");
    }
}
