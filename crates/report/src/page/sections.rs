//! What the page says, in order: the same for HTML and Markdown.

use super::format::{count, number, percent, quantile, rate, share, timing};
use super::pareto::words;
use super::table::{Cell, Table};
use crate::model::{Errors, Leaks, Panel, Point, Report};

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
            "Two independent oracles, rationals and floating-point expansions, answered {} of these rays and agree on every bit",
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
            "Every error on this page is against the exact answer for the very f32 numbers given, in real arithmetic; every \
             time was taken in the same run, in turn. Measured on {}, with {}, on {}: a {} report of rayproof {}, seed {}.",
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
        "Sphere: {} Triangle: {} ns: nanoseconds a test by the device's clock where it has one. M rays/s: through a tree, end to \
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
        "Which to take: exact where a wrong hit costs anything ({} misclassified against fast's {} in the two workloads above; a test costs {} times \
         fast's{trees}). fast for pictures. double where the last answers at edges and tangents do not matter but digits do, and f64 is \
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
    let ids = || report.methods.iter().map(|m| m.id.as_str());
    let head = ["family", "rays", "hit"].into_iter().chain(ids()).chain(["in f32", "wider", "exactly"]);
    let mut table = Table::new(1, head);
    for family in &report.families {
        let mut row = vec![Cell::from(format!("{} {}", family.number, family.name))];
        row.extend([count(family.rays), count(family.hits)].map(Cell::from));
        for id in ids() {
            let found = family.rows.iter().find(|r| r.method == id && r.device == on);
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
    let text = "Each cell: the worst error of t in ULP, and how many rays were misclassified. The last three columns: where the cascade \
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
        "method",
        "device",
        "missed",
        "false hits",
        "other primitive",
        "t: 50 %",
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
        let mut cells = vec![row.method.clone(), device(report, row.device).to_owned()];
        cells.extend([&e.misses, &e.false_hits, &e.wrong_primitive].map(rate));
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
    let text = "From inside closed meshes, exactly at vertices and edges: a ray that hits nothing has leaked, and an even count takes inside \
                for outside. exact counts crossings; for the others every triangle that claims the ray is counted, on the CPU engine.";
    Section::new("Leaks, double counts, parity", &[text], table)
}

pub(crate) fn invariants(report: &Report) -> Section {
    let mut table = Table::new(4, ["change", "primitive", "method", "device", "hit or primitive changed", "t changed"]);
    for i in &report.invariants {
        let (who, d) = (i.method.clone(), device(report, i.device).to_owned());
        table.row([i.change.clone(), i.primitive.clone(), who, d, rate(&i.verdict), rate(&i.t)]);
    }
    let text = "Real arithmetic's answer does not depend on the order of vertices or axes, and scales by powers of two. For exact every bit \
                must hold.";
    Section::new("Invariants", &[text], table)
}

pub(crate) fn scenes(report: &Report) -> Section {
    let head = ["scene", "rays", "who", "tree, s", "M rays/s", "kernel alone", "t: 99 %", "worst", "misclassified"];
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
                quantile(&e.errors.t, |t| t.p99),
                quantile(&e.errors.t, |t| t.max),
                rate(&e.errors.wrong),
            ]);
        }
    }
    Section::new("Whole scenes", &["The errors are those of a sample of the same rays."], table)
}

pub(crate) fn peers(report: &Report) -> Section {
    let mut table = Table::new(3, ["peer", "version", "measured", "how, or why not"]);
    for p in &report.peers {
        let measured = if p.measured { "yes" } else { "not measured" };
        table.row([p.name.clone(), p.version.clone(), measured.to_owned(), p.note.clone()]);
    }
    let text = "Other people's intersectors, in the same run, on the same rays, against the same oracle; their rows stand under leaks and \
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
        "In the same run, end to end, as their users call them; how, and on how many threads, stands under Peers. The errors are the worst over these scenes' samples; the leaks are those of the closed \
         mesh of {} triangles.",
        count(largest)
    );
    Section::new("Against peers", &[&text], table)
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
        "How many results of {} pairs of numbers are not those of IEEE 754, by the route that kernels take to the driver.",
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

/// Definitions.
pub(crate) fn reading() -> Section {
    let text = [
        "ULP: the distance between t and the exact t in units of the last place of the exact one; u and v likewise. 0.5 is what rounding to the nearest \
         costs, and no f32 can do better.",
        "Misclassified: a hit that is missed, a miss that is hit, or another primitive than the exact closest one.",
        "≤: with 95 % confidence the true share is no larger (Clopper and Pearson, one-sided); none of N means below about 3/N.",
        "Of condition: the error of t over what a rounding of every input may do to it. A few: the method is as good as its input; \
         thousands: it is the method that loses digits.",
        "Residual: what is left of the primitive's equation at the returned t, relative to its size, evaluated in f64. Gap: between e + t d and the point that u and v name.",
        "Margin: the exact distance of the ray's line from the silhouette or edge in units of 2^-24 of the largest coordinate: beyond a few, a wrong verdict is the method's.",
        "A case is a scene and a ray in hexadecimal floats; rayproof intersect answers it again to the bit.",
    ];
    let text = text.map(str::to_owned).into();
    Section { title: "How to read this".to_owned(), text, table: None, after: Vec::new() }
}
