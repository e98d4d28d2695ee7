//! stdin, stdout and stderr: what goes where, and nothing else.

use std::io::Read as _;

use super::{Folder, HITS, RAYS, csv_hits};

#[test]
fn a_pipe_gives_the_same_bytes_as_files() {
    let folder = Folder::with_scene();
    folder.run("rays scene.toml -o rays.npy --size 40x30").expect(0, &[]);
    let rays = folder.run("rays scene.toml -o - --size 40x30").expect(0, &["1,200"]).stdout;
    assert_eq!(rays, folder.read("rays.npy"));
    folder.run("intersect scene.toml rays.npy -o hits.npy --device cpu").expect(0, &[]);
    let hits = folder.run_with("intersect scene.toml - -o - --device cpu", &rays).expect(0, &["CPU"]).stdout;
    assert_eq!(hits, folder.read("hits.npy"));
}

#[test]
fn csv_on_stdin_is_recognised_and_csv_on_stdout_is_to_be_had() {
    let folder = Folder::with_scene();
    let ran = folder.run_with("intersect scene.toml - -o - --to csv --device cpu", RAYS.as_bytes()).expect(0, &[]);
    assert_eq!(csv_hits(&ran.stdout), HITS);
    // The number of rows is not known before the end, and stands at the start of an .npy file.
    let ran = folder.run_with("intersect scene.toml - -o - --device cpu", RAYS.as_bytes()).expect(0, &[]);
    folder.run("intersect scene.toml rays.csv -o hits.npy --device cpu").expect(0, &[]);
    assert_eq!(ran.stdout, folder.read("hits.npy"));
    folder
        .run_with("intersect scene.toml - -o hits.csv --shard 0/2 --device cpu", RAYS.as_bytes())
        .expect(2, &["--shard", "give a file"]);
}

#[test]
fn bad_rays_on_stdin_are_called_by_its_name() {
    let folder = Folder::with_scene();
    folder
        .run_with("intersect scene.toml - -o hits.csv", b"ox,oy,oz,dx,dy,dz\n0,0,0,0,0,0\n")
        .expect(5, &["-: line 2"]);
    folder.run_with("intersect scene.toml - -o hits.csv", b"").expect(5, &["-: line 1"]);
    let short = &super::npy_rays(&[[1.0; 6]; 10])[..200];
    folder.run_with("intersect scene.toml - -o hits.csv", short).expect(5, &["-: ", "10 rows"]);
    assert!(!folder.path("hits.csv").exists());
}

#[test]
fn json_is_one_object_on_stdout_with_the_names_of_the_contract() {
    let folder = Folder::with_scene();
    let line = "intersect scene.toml rays.csv -o hits.npy --device cpu --precision classic --query any --json --quiet";
    let ran = folder.run(line).expect(0, &[]);
    assert_eq!(ran.stderr, "");
    assert_eq!(ran.stdout.iter().filter(|&&b| b == b'\n').count(), 1);
    let json = ran.json();
    let keys = |value: &serde_json::Value| -> Vec<String> {
        let mut keys: Vec<String> = value.as_object().unwrap().keys().cloned().collect();
        keys.sort();
        keys
    };
    assert_eq!(
        keys(&json),
        [
            "checked",
            "correctly_rounded",
            "device",
            "disagreed",
            "driver",
            "hits",
            "invalid_rays",
            "notes",
            "precision",
            "query",
            "rays",
            "rays_per_second",
            "rounded_values",
            "rounding",
            "scene",
            "seconds",
            "undecided",
            "within_promise",
            "worst_ulp"
        ]
    );
    assert_eq!(
        keys(&json["scene"]),
        ["flattened_triangles", "geometries", "largest_shift", "rounded_values", "spheres", "triangles"]
    );
    assert_eq!(keys(&json["undecided"]), ["after_refine", "first_tier", "resolved_on_cpu"]);
    assert_eq!(keys(&json["seconds"]), ["build", "load", "resolve", "total", "trace"]);
    assert_eq!((&json["precision"], &json["query"]), (&"classic".into(), &"any".into()));
    assert_eq!(
        json["scene"].to_string(),
        r#"{"flattened_triangles":0,"geometries":2,"largest_shift":0.0,"rounded_values":0,"spheres":2,"triangles":2}"#
    );
    assert_eq!((&json["rays"], &json["hits"], &json["checked"]), (&5.into(), &4.into(), &0.into()));
    let seconds = |name: &str| json["seconds"][name].as_f64().unwrap();
    assert!(seconds("trace") > 0.0 && seconds("total") >= seconds("trace") + seconds("load"));
    let rate = json["rays_per_second"].as_f64().unwrap();
    assert!((rate * seconds("trace") / 5.0 - 1.0).abs() < 1e-6, "{rate}");
}

#[test]
fn stderr_is_plain_text_where_it_is_no_terminal_and_silent_on_request() {
    let folder = Folder::with_scene();
    let ran = folder.run("intersect scene.toml rays.csv -o hits.npy --device cpu").expect(0, &["device", "rays/s"]);
    assert!(!ran.stderr.contains(['\x1b', '\r']), "{:?}", ran.stderr);
    assert!(ran.stdout.is_empty());
    for line in [
        "intersect scene.toml rays.csv -o hits.npy --device cpu --quiet",
        "rays scene.toml -o new.npy --quiet",
        "render scene.toml -o picture.png --device cpu --quiet --size 8x8",
    ] {
        let ran = folder.run(line).expect(0, &[]);
        assert_eq!((ran.stderr.as_str(), ran.stdout.len()), ("", 0), "{line}");
    }
}

#[test]
fn a_reader_that_leaves_is_no_panic() {
    let folder = Folder::with_scene();
    for line in
        ["rays scene.toml -o - --kind incoherent --count 3000000", "rays scene.toml -o - --size 2000x2000 --to csv"]
    {
        let mut child = folder.spawn(line);
        let mut stdout = child.stdout.take().unwrap();
        stdout.read_exact(&mut [0; 64]).unwrap();
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        super::Ran::of(line, output).expect(1, &["-: "]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_exit_code_1() {
    let folder = Folder::with_scene();
    folder.run_with("intersect scene.toml rays.csv -o full.csv", b"").expect(0, &[]);
    std::os::unix::fs::symlink("/dev/full", folder.path("full.npy")).unwrap();
    folder.run("intersect scene.toml rays.csv -o full.npy --device cpu").expect(1, &["full.npy", "space"]);
    folder.run("rays scene.toml -o full.npy").expect(1, &["full.npy", "space"]);
    std::os::unix::fs::symlink("/dev/full", folder.path("full.png")).unwrap();
    folder.run("render scene.toml -o full.png --device cpu --size 8x8").expect(1, &["full.png", "space"]);
}
