use super::{html, markdown, plot};
use crate::measure::engines;
use crate::measure::tests::{report, without_anything};
use crate::model::{Case, Peer, Rate, Report};

/// A report with everything in it: another device, a peer, text that must be escaped.
fn full() -> Report {
    let mut report = report(&engines);
    let mut second = report.devices[0].clone();
    second.name = "GPU <\"&>".to_owned();
    report.devices.push(second);
    for panel in &mut report.panels {
        let more: Vec<_> = panel.points.iter().cloned().map(|p| crate::model::Point { device: 1, ..p }).collect();
        panel.points.extend(more);
    }
    report.families[3].rows[0].errors.worst = Some(Case {
        scene: "[[geometry]]\nspheres = <&>\n".to_owned(),
        rays: "ox\n1\n".to_owned(),
        exact: "miss".to_owned(),
        answer: "hit 0".to_owned(),
        ulp: Some(3.0),
        replays: false,
    });
    report.peers.push(Peer {
        name: "Embree".to_owned(),
        version: "4".to_owned(),
        note: "a | b".to_owned(),
        measured: true,
    });
    report
}

#[test]
fn pages_are_made_of_the_json_alone() {
    let report = full();
    let read: Report = serde_json::from_str(&serde_json::to_string(&report).expect("serialises")).expect("reads back");
    assert_eq!(html(std::slice::from_ref(&read)), html(std::slice::from_ref(&report)));
    assert_eq!(markdown(std::slice::from_ref(&read)), markdown(std::slice::from_ref(&report)));
    assert_eq!(plot(std::slice::from_ref(&read)), plot(std::slice::from_ref(&report)));
    // A figure that changes in the JSON changes on the page.
    let mut other = report.clone();
    other.panels[0].points[0].errors.t.p999 = 123_456.0;
    other.leaks[0].leaked = Rate { count: 77, of: 12_345, bound: 0.9 };
    let page = html(&[other]);
    assert!(page.contains("123,456") && page.contains("77 of 12,345"));
}

#[test]
fn pages_are_whole() {
    let report = full();
    let page = html(&[report.clone(), report.clone()]);
    for title in [
        "In one table",
        "The precisions",
        "Report 2",
        "Speed against error",
        "A sphere that moves away",
        "The 42 families",
        "Leaks",
        "Invariants",
    ] {
        assert!(page.contains(title), "{title}");
    }
    for wrong in ["NaN", "inf<", "GPU <", "= <&>", "http://www.example", "<script", "src=", "undefined"] {
        assert!(!page.contains(wrong), "{wrong}");
    }
    let urls = page.matches("http").count();
    assert_eq!(urls, page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count(), "nothing is fetched");
    let mut drawings = 0;
    for part in page.split("<svg ").skip(1) {
        let svg = format!("<svg {}</svg>", part.split("</svg>").next().expect("a part"));
        if let Err(e) = roxmltree::Document::parse(&svg) {
            panic!("{e}\n{svg}");
        }
        drawings += 1;
    }
    assert_eq!(drawings, 2 + 2 * 2, "the plot twice, and two figures a report");
    assert!(roxmltree::Document::parse(&plot(std::slice::from_ref(&report))).is_ok());
    for row in markdown(&[report]).lines().filter(|line| line.starts_with('|')) {
        assert!(row.ends_with(" |"), "{row}");
    }
}

#[test]
fn what_was_not_measured_is_said() {
    let nothing = without_anything(&report(&engines));
    let page = html(std::slice::from_ref(&nothing));
    assert!(page.matches("Not measured in this report.").count() > 8);
    assert!(markdown(std::slice::from_ref(&nothing)).contains("Not measured in this report."));
    assert!(html(&[]).contains("There is no report"));
    assert!(roxmltree::Document::parse(&plot(std::slice::from_ref(&nothing))).is_ok());
}
