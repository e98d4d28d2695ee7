//! `rayproof report`: speed against error.

use serde_json::Value;

use super::Folder;

/// Every object in a JSON value that has these keys.
fn objects<'v>(value: &'v Value, keys: &[&str], found: &mut Vec<&'v Value>) {
    match value {
        Value::Object(map) => {
            if keys.iter().all(|key| map.contains_key(*key)) {
                found.push(value);
            }
            map.values().for_each(|value| objects(value, keys, found));
        }
        Value::Array(list) => list.iter().for_each(|value| objects(value, keys, found)),
        _ => {}
    }
}

#[test]
fn a_quick_report_ends_well_on_both_devices_and_its_cases_replay() {
    let folder = Folder::new();
    let ran = folder.run("report --quick --device gpu -o out").expect(0, &["out/report.html"]);
    assert!(ran.stdout.is_empty());
    let report: Value = serde_json::from_slice(&folder.read("out/report.json")).unwrap();
    assert_eq!(report["devices"].as_array().unwrap().len(), 2, "{}", report["devices"]);
    assert_eq!(report["oracles"]["disagreed"], 0);
    assert!(report["oracles"]["compared"].as_u64().unwrap() > 20_000);
    let mut rows = Vec::new();
    objects(&report, &["method", "device", "errors"], &mut rows);
    let exact: Vec<_> = rows.iter().filter(|row| row["method"] == "exact").collect();
    assert_eq!(exact.len(), 2 * (42 + 4), "42 families and four panels on two devices");
    for row in exact {
        assert_eq!(row["errors"]["wrong"]["count"], 0, "{row}");
        assert!(row["errors"]["t"]["max"].as_f64().unwrap() <= 0.5, "{row}");
    }
    let textbook = rows.iter().filter(|row| row["method"] == "textbook" && row["errors"]["wrong"]["count"] != 0);
    assert!(textbook.count() > 20, "cancellation is seen");
    replay(&folder, &rows);
    let mut cases = Vec::new();
    objects(&report, &["rays", "replays"], &mut cases);
    let not = cases.iter().filter(|case| case["replays"] == false).count();
    assert!(not * 100 < cases.len(), "{not} of {} cases do not replay", cases.len());

    folder.run("report --from out/report.json -o again").expect(0, &["again/report.html"]);
    for name in ["report.html", "report.md", "plot.svg"] {
        assert_eq!(folder.read(&format!("again/{name}")), folder.read(&format!("out/{name}")), "{name}");
    }
    let before = folder.read("out/report.json");
    folder.write("other.json", &before);
    folder.run("report --from other.json out/report.json -o out --quiet").expect(0, &[]);
    assert!(folder.read("out/report.json") == before, "what is read is not written");
    let text = String::from_utf8(folder.read("out/report.html")).unwrap();
    assert!(text.contains("[report 2]") && text.contains("Report 2"));
}

/// Answers one case a method and device again by the command line, from what the report says.
fn replay(folder: &Folder, rows: &[&Value]) {
    let mut replayed = 0;
    for row in rows.iter().step_by(29) {
        let case = &row["errors"]["worst"];
        let Some(scene) = case["scene"].as_str() else { continue };
        if case["replays"] == false {
            continue;
        }
        folder.write("case.toml", scene);
        folder.write("case.csv", case["rays"].as_str().unwrap());
        let method = row["method"].as_str().unwrap();
        let device = if row["device"] == 0 { "cpu" } else { "gpu" };
        let line = format!("intersect case.toml case.csv -o hits.csv --precision {method} --device {device}");
        folder.run(&line).expect(0, &[]);
        let hits = String::from_utf8(folder.read("hits.csv")).unwrap();
        let t: f32 = hits.lines().nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
        let answer = case["answer"].as_str().unwrap();
        assert!(answer.ends_with(&format!("({t:?})")), "{line}: {answer}, {t:?}\n{scene}{}", case["rays"]);
        replayed += 1;
    }
    assert!(replayed > 10, "{replayed} cases");
}

#[test]
fn what_cannot_be_reported_is_said() {
    let folder = Folder::with_scene();
    folder.write("old.json", "{\"schema\": 0}");
    folder.write("file", "");
    for (line, code, part) in [
        ("report --quick -o file", 2, "file: a report is several files; give a folder"),
        ("report --quick -o -", 2, "give a folder"),
        ("report --quick -o out --device index:99", 4, "there is no adapter 99"),
        ("report --quick -o out --scene none.ply", 5, "none.ply"),
        ("report --from none.json -o out", 5, "none.json"),
        ("report --from scene.toml -o out", 5, "give a report.json of schema 1"),
        ("report --from old.json -o out", 5, "give a report.json of schema 1"),
        ("report --from old.json --quick -o out", 2, "cannot be used with"),
        ("report --quick -o none/out --from old.json", 2, "cannot be used with"),
    ] {
        folder.run(line).expect(code, &[part]);
    }
    assert!(!folder.names().contains(&"out".to_owned()));
}
