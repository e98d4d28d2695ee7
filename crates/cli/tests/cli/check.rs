//! `--check`: the oracle's word on the answers, and exit code 3.

use super::{Folder, npy_data, npy_rays};

/// A unit sphere seen from so far that the textbook formula in single precision goes wrong: half of the rays pass just
/// inside the rim, half just outside.
fn far_sphere() -> Folder {
    let folder = Folder::new();
    folder.write("far.toml", "[[geometry]]\nspheres = [[0.0, 0.0, 0.0, 1.0]]\n");
    let row = |i: usize| {
        let angle = i as f32 * 0.1;
        let off = if i.is_multiple_of(2) { 0.98 } else { 1.02 };
        [off * angle.cos(), off * angle.sin(), 3000.0, 0.0, 0.0, -1.0]
    };
    folder.write("rays.npy", npy_rays(&(0..100).map(row).collect::<Vec<_>>()));
    folder
}

#[test]
fn a_disagreement_is_printed_and_is_exit_code_3_and_the_hits_are_written() {
    let folder = far_sphere();
    let line = "intersect far.toml rays.npy -o hits.npy --device cpu --precision classic --check 100 --json";
    let ran = folder.run(line).expect(3, &["disagrees", "origin", "exact", "answer", "0x", "disagreements more"]);
    let json = ran.json();
    let wrong = json["disagreed"].as_u64().unwrap();
    assert_eq!(json["checked"], 100);
    assert!(wrong > 10 && wrong <= 100, "{json}");
    assert_eq!(ran.stderr.matches("disagrees").count(), 10, "{}", ran.stderr);
    assert!(ran.stderr.contains(&format!("... and {} disagreements more", wrong - 10)), "{}", ran.stderr);
    assert_eq!(npy_data(&folder.read("hits.npy")).len(), 100 * 20);
    // Disagreements are not for --quiet to hide.
    folder.run(&format!("{line} --quiet")).expect(3, &["disagrees"]);
}

#[test]
fn the_fast_tier_passes_where_the_classic_one_fails() {
    let folder = far_sphere();
    for query in ["closest", "any"] {
        let ran = folder.run(&format!(
            "intersect far.toml rays.npy -o hits.npy --device cpu --precision fast --query {query} --check 100 --json"
        ));
        let json = ran.expect(0, &["100 rays against exact arithmetic"]).json();
        assert_eq!((&json["checked"], &json["disagreed"]), (&100.into(), &0.into()));
        assert_eq!(json["hits"], 50);
    }
}

#[test]
fn the_exact_tier_is_exact() {
    let folder = far_sphere();
    for query in ["closest", "any", "count"] {
        let ran = folder
            .run(&format!("intersect far.toml rays.npy -o hits.npy --device cpu --query {query} --check 100 --json"));
        let json = ran.expect(0, &["100 are exact", "open "]).json();
        assert_eq!((&json["precision"], &json["correctly_rounded"]), (&"exact".into(), &100.into()));
        assert_eq!((&json["disagreed"], &json["hits"]), (&0.into(), &50.into()));
    }
}

#[test]
fn as_many_rays_are_checked_as_asked_whether_their_number_is_known_or_not() {
    let folder = Folder::with_scene();
    folder.run("rays scene.toml -o rays.npy --size 40x30").expect(0, &[]);
    folder.run("rays scene.toml -o rays.csv --size 40x30").expect(0, &[]);
    for rays in ["rays.npy", "rays.csv"] {
        for (check, checked) in [(0, 0), (1, 1), (77, 77), (1200, 1200), (9999, 1200)] {
            let line = format!("intersect scene.toml {rays} -o hits.npy --device cpu --json --check {check}");
            let json = folder.run(&line).expect(0, &[]).json();
            assert_eq!(json["checked"], checked, "{line}");
            assert_eq!(json["disagreed"], 0, "{line}");
        }
    }
}

#[test]
fn the_summary_says_how_many_answers_are_exact_and_how_far_off_the_others_are() {
    let folder = Folder::with_scene();
    let line = "intersect scene.toml rays.csv -o hits.csv --device cpu --check 5 --json";
    let ran =
        folder.run(line).expect(0, &["0 disagree", "5 are exact: a miss, or", "0 have the exact", "0 ULP at worst"]);
    let json = ran.json();
    assert_eq!((&json["correctly_rounded"], &json["worst_ulp"]), (&5.into(), &0.into()));
    let ran = folder.run(&format!("{line} --query any")).expect(0, &["5 are exact\n", "0 differ within the promise"]);
    assert_eq!((&ran.json()["correctly_rounded"], &ran.json()["worst_ulp"]), (&5.into(), &serde_json::Value::Null));
    // A sphere of radius 1e6 seen from 1 above: some digits of t are lost.
    folder.write("ground.toml", "[[geometry]]\nspheres = [[0.0, -1e6, 0.0, 1e6]]\n");
    let row = |i: usize| [0.0, 1.0, 0.0, i as f32 * 0.01, -1.0, 0.0];
    folder.write("down.npy", npy_rays(&(0..100).map(row).collect::<Vec<_>>()));
    let line = "intersect ground.toml down.npy -o hits.npy --device cpu --check 100 --json";
    let json = folder.run(line).expect(0, &["100 are exact", "0 ULP at worst"]).json();
    assert_eq!(json["undecided"]["first_tier"], 100, "they are beyond f32");
    let ran = folder.run(&format!("{line} --precision fast")).expect(0, &["0 disagree"]);
    let json = ran.json();
    let [right, within, worst] =
        ["correctly_rounded", "within_promise", "worst_ulp"].map(|k| json[k].as_u64().unwrap());
    let off = 100 - right - within;
    assert!(off > 0 && worst > 0, "{json}");
    let said = format!("{off} have the exact primitive and t off, by {} ULP at worst", grouped(worst));
    assert!(ran.stderr.contains(&said), "{said}\n{}", ran.stderr);
}

/// With commas between thousands, for numbers below a million.
fn grouped(n: u64) -> String {
    if n < 1000 { n.to_string() } else { format!("{},{:03}", n / 1000, n % 1000) }
}

#[test]
fn classic_promises_nothing_so_that_every_lost_hit_is_a_disagreement() {
    let folder = Folder::new();
    folder.write("huge.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1e30 0\nf 1 2 3\n");
    let row = |i: usize| [1e29, 2e28 * (i as f32 + 1.0), 1e30, 0.0, 0.0, -1e30];
    folder.write("rays.npy", npy_rays(&(0..10).map(row).collect::<Vec<_>>()));
    let line = "intersect huge.obj rays.npy -o hits.npy --device cpu --precision classic --check 10 --json";
    for query in ["closest", "any"] {
        let ran = folder.run(&format!("{line} --query {query}")).expect(3, &["disagrees", "classic promises no other"]);
        let json = ran.json();
        assert_eq!((&json["hits"], &json["disagreed"], &json["within_promise"]), (&0.into(), &10.into(), &0.into()));
    }
}
