//! Leaks, invariants, whole scenes, peers, and what ran.

use super::{Section, device};
use crate::model::{Leaks, Report};
use crate::page::format::{count, number, quantile, rate, share, timing};
use crate::page::table::Table;

pub(crate) fn leaks(report: &Report) -> Section {
    let mut table = Table::new(3, ["mesh", "aimed at", "who", "hit nothing", "even count", "counted too often"]);
    for l in &report.leaks {
        table.row([
            format!("{}, {} triangles", l.mesh, count(l.triangles)),
            l.target.clone(),
            l.who.clone(),
            rate(&l.leaked),
            l.even.as_ref().map_or("does not count".to_owned(), rate),
            l.double.as_ref().map_or("does not count".to_owned(), rate),
        ]);
    }
    let text = "From inside closed meshes, exactly at vertices and edges: a ray that hits nothing has leaked, \
    and an even count takes inside \
                for outside. exact counts crossings; for the others every triangle that claims the ray is \
                counted, on the CPU engine.";
    Section::new("Leaks, double counts, parity", &[text], table)
}

pub(crate) fn invariants(report: &Report) -> Section {
    let mut table =
        Table::new(4, ["change", "primitive", "precision", "device", "hit or primitive changed", "t changed"]);
    for i in &report.invariants {
        let (who, d) = (i.precision.clone(), device(report, i.device).to_owned());
        table.row([i.change.clone(), i.primitive.clone(), who, d, rate(&i.verdict), rate(&i.t)]);
    }
    let text = "Real arithmetic's answer does not depend on the order of vertices or axes, and scales by powers \
    of two. For exact every bit \
                must hold.";
    Section::new("Invariants", &[text], table)
}

pub(crate) fn scenes(report: &Report) -> Section {
    let head = [
        "scene",
        "rays",
        "who",
        "tree, s",
        "M rays/s",
        "kernel alone, M rays/s",
        "hits judged",
        "t, ULP: 99 %",
        "worst",
        "misclassified",
    ];
    let mut table = Table::new(3, head);
    for scene in &report.scenes {
        for e in &scene.rows {
            table.row([
                scene.scene.clone(),
                scene.rays.clone(),
                e.who.clone(),
                number(e.build.median),
                timing(&e.mrays),
                e.kernel_mrays.as_ref().map_or("–".to_owned(), timing),
                count(e.errors.t.n),
                quantile(&e.errors.t, |t| t.p99),
                quantile(&e.errors.t, |t| t.max),
                rate(&e.errors.wrong),
            ]);
        }
    }
    Section::new("Whole scenes", &["The errors are those of a sample of the same rays."], table)
}

pub(crate) fn peers(report: &Report) -> Section {
    let mut table = Table::new(4, ["peer", "version", "measured", "how, or why not"]);
    for p in &report.peers {
        let measured = if p.measured { "yes" } else { "not measured" };
        table.row([p.name.clone(), p.version.clone(), measured.to_owned(), p.note.clone()]);
    }
    let text = "Other people's intersectors, in the same run, on the same rays, against the same oracle; their \
    rows stand under leaks and \
                whole scenes. Nothing here is copied from elsewhere.";
    Section::new("Peers", &[text], table)
}

/// Our fast and exact beside the peers: speed, error and leaks in a row each.
pub(crate) fn against(report: &Report) -> Section {
    // Peers take meshes: the scenes on which one was measured.
    let scenes: Vec<_> = report.scenes.iter().filter(|s| s.rows.iter().any(|r| r.peer)).collect();
    let leaks: Vec<&Leaks> = report.leaks.iter().collect();
    let largest = leaks.iter().map(|l| l.triangles).max().unwrap_or(0);
    let mut head = vec!["who".to_owned()];
    head.extend(scenes.iter().map(|s| format!("{}, {}: M rays/s", s.scene, s.rays)));
    head.extend(["worst ULP", "misclassified", "leaks: vertices", "edges"].map(str::to_owned));
    let mut table = Table::new(1, head);
    let ours = |who: &str| who.starts_with("fast on") || who.starts_with("exact on");
    let first = scenes.first().map_or(&[][..], |s| &s.rows[..]);
    for entry in first.iter().filter(|e| e.peer || ours(&e.who)) {
        let rows = || scenes.iter().filter_map(|s| s.rows.iter().find(|r| r.who == entry.who));
        let mut row = vec![entry.who.clone()];
        row.extend(scenes.iter().map(|s| {
            let found = s.rows.iter().find(|r| r.who == entry.who);
            found.map_or("–".to_owned(), |r| number(r.mrays.median))
        }));
        let worst = rows().map(|r| r.errors.t.max).fold(0.0, f64::max);
        let (wrong, of) = rows().fold((0, 0), |(n, of), r| (n + r.errors.wrong.count, of + r.errors.wrong.of));
        row.extend([number(worst), format!("{} of {}", count(wrong), count(of))]);
        row.extend(["vertices", "edges"].map(|target| {
            let of = leaks.iter().find(|l| l.who == entry.who && l.target == target && l.triangles == largest);
            of.map_or("–".to_owned(), |l| share(&l.leaked))
        }));
        table.row(row);
    }
    let text = format!(
        "In the same run, end to end, as their users call them; how, and on how many threads, stands under \
        Peers. The errors are the worst over these scenes' samples; the leaks are those of the closed \
         mesh of {} triangles.",
        count(largest)
    );
    Section::new("Against peers", &[&text], table)
}

pub(crate) fn devices(report: &Report) -> Section {
    let mut table = Table::new(4, ["device", "driver", "kind", "notes"]);
    for d in &report.devices {
        table.row([d.name.clone(), d.driver.clone(), d.kind.clone(), d.notes.join("; ")]);
    }
    Section::new("Devices", &[], table)
}

pub(crate) fn arithmetic(report: &Report) -> Section {
    let operations: Vec<String> = report
        .devices
        .iter()
        .flat_map(|d| &d.arithmetic)
        .next()
        .map(|a| a.wrong.iter().map(|(name, _)| name.clone()).collect())
        .unwrap_or_default();
    let head =
        ["device", "route", "verdict"].map(str::to_owned).into_iter().chain(operations).chain(["fma".to_owned()]);
    let mut table = Table::new(3, head);
    for d in &report.devices {
        for a in &d.arithmetic {
            let verdict = if a.ieee { "IEEE: the CPU's bits" } else { "not IEEE" };
            let mut row = vec![d.name.clone(), a.route.clone(), verdict.to_owned()];
            row.extend(
                a.wrong.iter().map(|(_, n)| if *n == 0 { "right".to_owned() } else { format!("{} wrong", count(*n)) }),
            );
            row.push(if a.fma_fused { "fused" } else { "not fused" }.to_owned());
            table.row(row);
        }
    }
    let pairs = report.devices.iter().flat_map(|d| &d.arithmetic).map(|a| a.pairs).max().unwrap_or(0);
    let text = format!(
        "How many results of {} pairs of numbers are not those of IEEE 754, by the route that kernels take to \
        the driver.",
        count(pairs)
    );
    Section::new("Arithmetic of the devices", &[&text], table)
}

pub(crate) fn rules(report: &Report) -> Section {
    let head = ["device", "rules", "workload", "ns a ray", "over exact rules", "rays with other bits"];
    let mut table = Table::new(3, head);
    for d in &report.devices {
        for r in &d.rules {
            table.row([
                d.name.clone(),
                r.rules.clone(),
                r.workload.split(':').next().unwrap_or_default().to_owned(),
                timing(&r.ns_per_ray),
                timing(&r.ratio),
                format!("{} of {}", count(r.different), count(r.rays)),
            ]);
        }
    }
    let text =
        "The kernel of fast with and without NoContraction, and as plain WGSL with and without wgpu's runtime checks.";
    Section::new("The price of exact f32 rules", &[text], table)
}
