//! The 42 families: at a glance, and each in full.

use super::{Section, device};
use crate::model::{Errors, Report};
use crate::page::format::{count, number, percent, quantile, rate};
use crate::page::table::{Cell, Table};

/// How dark a cell is: the decades of the worst error, and at once where a verdict is wrong.
fn shade(errors: &Errors) -> u8 {
    let worst = errors.t.max;
    match () {
        () if errors.wrong.count > 0 && worst > 1e3 => 4,
        () if errors.wrong.count > 0 || worst > 1e3 => 3,
        () if worst > 16.0 => 2,
        () if worst > 0.5 => 1,
        () => 0,
    }
}

/// The families at a glance, on one device.
pub(crate) fn matrix(report: &Report, on: usize) -> Section {
    let ids = || report.precisions.iter().map(|m| m.id.as_str());
    let head = ["family", "rays", "hit"].into_iter().chain(ids()).chain(["in f32", "wider", "exactly"]);
    let mut table = Table::new(1, head);
    for family in &report.families {
        let mut row = vec![Cell::from(format!("{} {}", family.number, family.name))];
        row.extend([count(family.rays), count(family.hits)].map(Cell::from));
        for id in ids() {
            let found = family.rows.iter().find(|r| r.precision == id && r.device == on);
            row.push(found.map_or_else(
                || "–".into(),
                |r| {
                    let wrong = r.errors.wrong.count;
                    let text = format!(
                        "{} · {}",
                        quantile(&r.errors.t, |t| t.max),
                        if wrong == 0 { "0".to_owned() } else { format!("{} wrong", count(wrong)) }
                    );
                    Cell::shaded(text, shade(&r.errors))
                },
            ));
        }
        let d = &family.decided;
        let part = |n: u64| percent(n as f64 / d.rays.max(1) as f64);
        row.extend([d.first, d.refined, d.resolved].map(|n| Cell::from(part(n))));
        table.row(row);
    }
    let text = "Each cell: the worst error of t in ULP, and how many rays were misclassified. The last three \
    columns: where the cascade \
                of exact decided. Darker is worse.";
    let mut section =
        Section::new(&format!("The 42 families of hard cases, on {}", device(report, on)), &[text], table);
    section.after.push(bits(report));
    section
}

/// Whether other devices have the first one's bits.
fn bits(report: &Report) -> String {
    let rows = || report.families.iter().flat_map(|f| &f.rows).filter(|r| r.same_bits.is_some());
    let (all, same) = (rows().count(), rows().filter(|r| r.same_bits == Some(true)).count());
    if all == 0 {
        return String::new();
    }
    format!(
        "On the other devices {} of {} rows have the same answers in every bit.",
        count(same as u64),
        count(all as u64)
    )
}

/// A family in full, and its cases.
pub(crate) fn family(report: &Report, family: &crate::model::Family) -> Table {
    let head = [
        "precision",
        "device",
        "missed",
        "false hits",
        "other primitive",
        "hits compared",
        "t, ULP: 50 %",
        "90 %",
        "99 %",
        "99.9 %",
        "worst",
        "u: 99 %",
        "worst",
        "v: 99 %",
        "worst",
        "of condition: 99 %",
        "worst",
        "residual, worst",
        "gap, worst",
    ];
    let mut table = Table::new(2, head);
    for row in &family.rows {
        let e = &row.errors;
        let mut cells = vec![row.precision.clone(), device(report, row.device).to_owned()];
        cells.extend([&e.misses, &e.false_hits, &e.wrong_primitive].map(rate));
        cells.push(count(e.t.n));
        cells.extend(
            [e.t.p50, e.t.p90, e.t.p99, e.t.p999, e.t.max].map(|x| if e.t.n == 0 { "–".to_owned() } else { number(x) }),
        );
        for q in [&e.u, &e.v, &e.normalised] {
            cells.extend([quantile(q, |q| q.p99), quantile(q, |q| q.max)]);
        }
        cells.extend([&e.residual, &e.gap].map(|q| quantile(q, |q| q.max)));
        table.row(cells);
    }
    table
}
