//! The table that matters, which precision to take, and the figures of the plot.

use super::{Section, device, labelled, who};
use crate::model::{Leaks, Panel, Point, Report};
use crate::page::format::{count, number, quantile, rate, share, timing};
use crate::page::pareto::words;
use crate::page::table::Table;

/// The first panel of a primitive: the ordinary one.
fn ordinary<'r>(report: &'r Report, primitive: &str) -> Option<&'r Panel> {
    report.panels.iter().find(|p| p.primitive == primitive)
}

fn point<'r>(panel: Option<&'r Panel>, precision: &str, device: usize) -> Option<&'r Point> {
    panel?.points.iter().find(|p| p.precision == precision && p.device == device)
}

/// The one table that matters: the devices of all reports.
pub(crate) fn summary(reports: &[Report]) -> Section {
    let head = [
        "precision",
        "device",
        "sphere: ns a test",
        "99.9 %, ULP",
        "worst",
        "misclassified",
        "triangle: ns a test",
        "99.9 %, ULP",
        "worst",
        "misclassified",
        "hard families with wrong rays",
        "worst, ULP",
        "leaks at vertices",
        "at edges",
    ];
    let mut table = Table::new(2, head);
    for (k, report) in reports.iter().enumerate() {
        for i in 0..report.devices.len() {
            for precision in &report.precisions {
                table.rows_extend(row(report, k, &precision.id, i));
            }
        }
    }
    let first = |primitive| {
        let panel = reports.first().and_then(|report| ordinary(report, primitive));
        panel.map_or("not measured.", |p| p.workload.as_str()).to_owned()
    };
    let mut section = Section::new("In one table", &[], table);
    section.text.push(format!(
        "The sphere columns: {} The triangle columns: {} Times are medians, by the device's clock where it has one. ULP: \
         units in the last place of the exact t, over the hits whose primitive is right; 0.5 is what rounding costs. \
         ≤: the 95 % bound where none was seen. Then the 42 families of hard cases, each counted by itself; and rays from \
         inside closed meshes, aimed at vertices and edges, that hit nothing, on the worst of the meshes.",
        first("sphere"),
        first("triangle")
    ));
    for (k, report) in reports.iter().enumerate() {
        section.after.extend(advice(report, k));
    }
    section
}

fn row(report: &Report, k: usize, precision: &str, i: usize) -> Option<Vec<String>> {
    let points = ["sphere", "triangle"].map(|primitive| point(ordinary(report, primitive), precision, i));
    if points == [None, None] {
        return None;
    }
    let mut row = vec![precision.to_owned(), labelled(report, k, i)];
    for point in points {
        row.extend(point.map_or_else(
            || [(); 4].map(|()| "–".to_owned()),
            |p| {
                let [ns, _] = words(p);
                let t = &p.errors.t;
                [ns, quantile(t, |t| t.p999), quantile(t, |t| t.max), share(&p.errors.wrong)]
            },
        ));
    }
    let hard = Hard::of(report, precision, i);
    row.push(format!("{} of {}", hard.wrong, hard.families));
    row.push(number(hard.worst));
    let name = who(report, precision, i);
    row.extend(["vertices", "edges"].map(|target| worst_leak(&report.leaks, &name, target)));
    Some(row)
}

/// What the families say of a precision on a device.
struct Hard {
    families: usize,
    /// In which some ray was misclassified.
    wrong: usize,
    /// The worst error of `t` in any of them, and in which.
    worst: f64,
    name: String,
}

impl Hard {
    fn of(report: &Report, precision: &str, device: usize) -> Self {
        let mut hard = Self { families: 0, wrong: 0, worst: 0.0, name: String::new() };
        for family in &report.families {
            let Some(row) = family.rows.iter().find(|r| r.precision == precision && r.device == device) else {
                continue;
            };
            hard.families += 1;
            hard.wrong += usize::from(row.errors.wrong.count > 0);
            if row.errors.t.max > hard.worst {
                (hard.worst, hard.name) = (row.errors.t.max, family.name.clone());
            }
        }
        hard
    }
}

fn worst_leak(leaks: &[Leaks], who: &str, target: &str) -> String {
    let of = leaks.iter().filter(|l| l.who == who && l.target == target && l.leaked.of > 0);
    let worst = of.max_by(|a, b| (a.leaked.count * b.leaked.of).cmp(&(b.leaked.count * a.leaked.of)));
    worst.map_or("–".to_owned(), |leaks| share(&leaks.leaked))
}

/// Which precision to take, and what exact costs on each device; ratios are medians of ratios within a round.
fn advice(report: &Report, k: usize) -> Vec<String> {
    let mut all = Vec::new();
    for i in 0..report.devices.len() {
        let tests = ["sphere", "triangle"].map(|primitive| point(ordinary(report, primitive), "exact", i));
        let [Some(sphere), Some(triangle)] = tests else { continue };
        let name = who(report, "exact", i);
        let kept = report.scenes.iter().filter_map(|s| s.rows.iter().find(|r| r.who == name)?.of_fast);
        let (low, high) = kept.fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(r.median), b.max(r.median)));
        let scenes = if low.is_finite() {
            format!(
                "; through a tree, in whole scenes, it keeps {} to {} of fast's rays a second",
                number(low),
                number(high)
            )
        } else {
            String::new()
        };
        all.push(format!(
            "{}: a test by exact takes {} times as long as by fast on these spheres, and {} on these triangles{scenes}.",
            labelled(report, k, i),
            timing(&sphere.of_fast),
            timing(&triangle.of_fast)
        ));
    }
    let [double, fast] = ["double", "fast"].map(|precision| Hard::of(report, precision, 0));
    if double.families > 0 {
        all.push(format!(
            "Which to take: exact where a wrong hit costs anything. double, plain f64, looks as good on ordinary rays, yet it misclassified \
             rays in {} of the {} hard families and its t was off by {} ULP at worst ({}). fast for pictures: wrong in {} families. \
             textbook and classic are here to be compared with, pair is for devices without f64.",
            double.wrong,
            double.families,
            number(double.worst),
            double.name,
            fast.wrong
        ));
    }
    all
}

/// Every figure of the plot.
pub(crate) fn points(report: &Report) -> Section {
    let head = [
        "workload",
        "precision",
        "device",
        "ns a test, kernel",
        "ns a test, end to end",
        "M rays/s, tree of 64",
        "hits compared",
        "t, ULP: 50 %",
        "99 %",
        "99.9 %",
        "worst",
        "of condition, 99 %",
        "misclassified",
    ];
    let mut table = Table::new(3, head);
    for panel in &report.panels {
        for p in &panel.points {
            let e = &p.errors;
            table.row([
                panel.workload.split(':').next().unwrap_or_default().to_owned(),
                p.precision.clone(),
                device(report, p.device).to_owned(),
                p.kernel_ns.as_ref().map_or("–".to_owned(), timing),
                timing(&p.ns),
                timing(&p.mrays),
                count(e.t.n),
                quantile(&e.t, |t| t.p50),
                quantile(&e.t, |t| t.p99),
                quantile(&e.t, |t| t.p999),
                quantile(&e.t, |t| t.max),
                quantile(&e.normalised, |q| q.p99),
                rate(&e.wrong),
            ]);
        }
    }
    Section::new("The figures of the plot", &["Times are medians with the 5th and 95th percentile."], table)
}
