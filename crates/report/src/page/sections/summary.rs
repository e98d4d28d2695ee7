//! The table that matters, which method to take, and the figures of the plot.

use super::{Section, device, who};
use crate::model::{Leaks, Panel, Point, Report};
use crate::page::format::{count, number, quantile, rate, share, timing};
use crate::page::pareto::words;
use crate::page::table::Table;

/// The first panel of a primitive: the ordinary one.
fn ordinary<'r>(report: &'r Report, primitive: &str) -> Option<&'r Panel> {
    report.panels.iter().find(|p| p.primitive == primitive)
}

fn point<'r>(panel: Option<&'r Panel>, method: &str, device: usize) -> Option<&'r Point> {
    panel?.points.iter().find(|p| p.method == method && p.device == device)
}

/// The one table that matters.
pub(crate) fn summary(report: &Report) -> Section {
    let mut table = Table::new(
        2,
        [
            "method",
            "device",
            "sphere: ns",
            "M rays/s",
            "ULP 99.9 %",
            "worst",
            "misclassified",
            "triangle: ns",
            "M rays/s",
            "ULP 99.9 %",
            "worst",
            "misclassified",
            "leaks: vertices",
            "edges",
        ],
    );
    let panels = ["sphere", "triangle"].map(|primitive| ordinary(report, primitive));
    for (i, d) in report.devices.iter().enumerate() {
        for method in &report.methods {
            let points = panels.map(|panel| point(panel, &method.id, i));
            if points == [None, None] {
                continue;
            }
            let mut row = vec![method.id.clone(), d.name.clone()];
            for point in points {
                row.extend(point.map_or_else(
                    || [(); 5].map(|()| "–".to_owned()),
                    |p| {
                        let [ns, rays] = words(p);
                        let t = &p.errors.t;
                        [ns, rays, quantile(t, |t| t.p999), quantile(t, |t| t.max), share(&p.errors.wrong)]
                    },
                ));
            }
            let name = who(report, &method.id, i);
            row.extend(["vertices", "edges"].map(|target| worst_leak(&report.leaks, &name, target)));
            table.row(row);
        }
    }
    let of = |panel: Option<&Panel>| panel.map_or("not measured", |p| p.workload.as_str()).to_owned();
    let mut section = Section::new("In one table", &[], table);
    section.text.push(format!(
        "Sphere: {} Triangle: {} ns: nanoseconds a test by the device's clock where it has one. M rays/s: \
        through a tree, end to \
         end. Leaks: rays from inside a closed mesh that hit nothing, on the worst of the meshes.",
        of(panels[0]),
        of(panels[1])
    ));
    section.after.extend(advice(report));
    section
}

fn worst_leak(leaks: &[Leaks], who: &str, target: &str) -> String {
    let of = leaks.iter().filter(|l| l.who == who && l.target == target && l.leaked.of > 0);
    let worst = of.max_by(|a, b| (a.leaked.count * b.leaked.of).cmp(&(b.leaked.count * a.leaked.of)));
    worst.map_or("–".to_owned(), |leaks| share(&leaks.leaked))
}

/// Which method to take, from the figures of the first device.
fn advice(report: &Report) -> Vec<String> {
    let figure = |method: &str| {
        let points: Vec<&Point> = ["sphere", "triangle"]
            .iter()
            .filter_map(|primitive| point(ordinary(report, primitive), method, 0))
            .collect();
        let time: f64 = points.iter().map(|p| p.ns.median).sum();
        let wrong: u64 = points.iter().map(|p| p.errors.wrong.count).sum();
        (!points.is_empty()).then_some((time, wrong))
    };
    let (Some((exact, exact_wrong)), Some((fast, fast_wrong))) = (figure("exact"), figure("fast")) else {
        return Vec::new();
    };
    let scenes = report.scenes.iter().filter_map(|scene| {
        let rate = |method: &str| scene.rows.iter().find(|r| r.who == who(report, method, 0)).map(|r| r.mrays.median);
        Some(rate("exact")? / rate("fast")?)
    });
    let (low, high) = scenes.fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(r), b.max(r)));
    let trees = if low.is_finite() {
        format!("; in whole scenes it keeps {} to {} of fast's rays a second", number(low), number(high))
    } else {
        String::new()
    };
    vec![format!(
        "Which to take: exact where a wrong hit costs anything ({} misclassified against fast's {} in the two \
        workloads above; a test costs {} times \
         fast's{trees}). fast for pictures. double where the last answers at edges and tangents do not matter \
         but digits do, and f64 is \
         cheap. textbook and classic are here to be compared with.",
        count(exact_wrong),
        count(fast_wrong),
        number(exact / fast)
    )]
}

/// Every figure of the plot.
pub(crate) fn points(report: &Report) -> Section {
    let head = [
        "workload",
        "method",
        "device",
        "ns a test, kernel",
        "ns a test, end to end",
        "M rays/s",
        "t: 50 %",
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
                p.method.clone(),
                device(report, p.device).to_owned(),
                p.kernel_ns.as_ref().map_or("–".to_owned(), timing),
                timing(&p.ns),
                timing(&p.mrays),
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
