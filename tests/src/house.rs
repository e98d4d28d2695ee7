//! Do the rooms know of each other only what the README's drawing says, and is the top level as tidy as it says?
#![expect(clippy::unwrap_used, reason = "a test")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Each room, and the rooms that it is built from. A new room is entered here and in the README.
const ROOMS: [(&str, &[&str]); 13] = [
    ("rayproof-shaders", &[]),
    ("rayproof-scene", &[]),
    ("rayproof-files", &["rayproof-scene"]),
    ("rayproof-tree", &["rayproof-scene"]),
    ("rayproof-gpu", &["rayproof-scene", "rayproof-shaders", "rayproof-tree"]),
    ("rayproof-cpu", &["rayproof-scene", "rayproof-tree"]),
    ("rayproof", &["rayproof-cpu", "rayproof-files", "rayproof-gpu", "rayproof-scene", "rayproof-tree"]),
    ("rayproof-oracle", &["rayproof-scene"]),
    ("rayproof-picture", &["rayproof-oracle", "rayproof-scene"]),
    ("rayproof-report", &["rayproof", "rayproof-gpu", "rayproof-oracle"]),
    ("rayproof-cli", &["rayproof", "rayproof-oracle", "rayproof-picture", "rayproof-report"]),
    ("rayproof-viewer", &["rayproof", "rayproof-oracle", "rayproof-picture"]),
    ("rayproof-tests", &[]),
];

/// What meets in `tests`, but for this: rooms that another room's tests look at, and why.
const TESTED: [(&str, &str, &str); 1] = [(
    "rayproof-cli",
    "rayproof-viewer",
    "both draw the same picture, and cargo hands the command to its own tests only",
)];

/// What reads or writes files, and nothing below the rooms that need it links.
const FORMATS: [&str; 11] =
    ["arrow", "csv", "gltf", "gltf-json", "npyz", "parquet", "ply-rs-bw", "serde_json", "stl_io", "tobj", "toml"];

/// How many crates the oracle is built from, itself included. A judge that links little has little to be wrong with.
const ORACLE_CLOSURE: usize = 25;

/// The only room that speaks to a device, and what it does that with.
const DEVICE_ROOM: &str = "rayproof-gpu";
const DEVICE_CRATES: [&str; 4] = ["wgpu", "naga", "ash", "spirv"];

/// What is at the top level beside dot-files.
const TOP: [&str; 8] =
    ["Cargo.lock", "Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "crates", "shaders", "tests"];

/// Where the twins of the kernels are.
const TWINS: &str = "crates/cpu/src/twin";

/// The kernels without a twin: a file, or all files of a folder, and why.
const WITHOUT_TWIN: [(&str, &str); 10] = [
    ("fingerprint.wgsl", "measures the device"),
    ("exact/number/trial.wgsl", "measures the device"),
    ("ray_query.wgsl", "a peer, not a kernel of ours"),
    ("query/", "entry points: on the CPU a batch is `engine.rs`"),
    ("exact/query/", "entry points: on the CPU a batch is `engine.rs`"),
    ("exact/list.wgsl", "what a pass leaves to the next: the CPU decides on the spot, in `exact/second.rs`"),
    ("exact/round/", "the CPU rounds otherwise and to the end, in `exact/values.rs`"),
    ("exact/number/narrow.wgsl", "a conversion that no compiler can fold: the CPU's is not folded"),
    ("exact/number/single_", "one line each: a roundoff, of which the CPU's stands in `number/single.rs`"),
    ("exact/number/pair_of_f32.wgsl", "two constants: the CPU's are `Part for f32` in `number/pair.rs`"),
];

/// A package's dependencies.
struct Room {
    /// To be built, optional ones included.
    built: BTreeSet<String>,
    /// For its tests and benchmarks.
    tested: BTreeSet<String>,
}

impl Room {
    fn of(package: &Value) -> Self {
        let names = |tested: bool| {
            let dependencies = package["dependencies"].as_array().unwrap().iter();
            let kept = dependencies.filter(|d| (d["kind"] == "dev") == tested);
            kept.map(|d| d["name"].as_str().unwrap().to_owned()).collect()
        };
        Self { built: names(false), tested: names(true) }
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

fn run(program: &str, arguments: &[&str]) -> Vec<u8> {
    let output = Command::new(program).args(arguments).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn rooms() -> BTreeMap<String, Room> {
    let output = run(env!("CARGO"), &["metadata", "--format-version", "1", "--no-deps", "--offline"]);
    let metadata: Value = serde_json::from_slice(&output).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    packages.iter().map(|package| (package["name"].as_str().unwrap().to_owned(), Room::of(package))).collect()
}

/// The names among these that are rooms.
fn ours(names: &BTreeSet<String>) -> Vec<&str> {
    names.iter().map(String::as_str).filter(|name| ROOMS.iter().any(|(room, _)| room == name)).collect()
}

#[test]
fn rooms_know_only_the_rooms_below_them() {
    let rooms = rooms();
    let there: BTreeSet<&str> = rooms.keys().map(String::as_str).collect();
    assert_eq!(there, ROOMS.iter().map(|(name, _)| *name).collect(), "a room has come or gone");
    for (name, knows) in ROOMS {
        assert_eq!(ours(&rooms[name].built), knows, "what {name} is built from");
    }
}

#[test]
fn no_test_of_a_room_looks_across_the_house() {
    // What meets there meets in `tests`: an engine's own tests know no other engine and no judge.
    for (name, room) in rooms().iter().filter(|(name, _)| *name != "rayproof-tests") {
        let mut found = ours(&room.tested);
        found.retain(|other| !room.built.contains(*other));
        let known: Vec<_> = TESTED.iter().filter(|(looks, ..)| looks == name).map(|(_, at, _)| *at).collect();
        assert_eq!(found, known, "what the tests of {name} look at");
    }
}

/// Every crate that a room is built from, itself included, on this system, and with its usual features.
fn closure(room: &str) -> BTreeSet<String> {
    let tree = ["tree", "--package", room, "--edges", "normal", "--prefix", "none", "--format", "{p}", "--offline"];
    let output = String::from_utf8(run(env!("CARGO"), &tree)).unwrap();
    output.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}

#[test]
fn engines_and_the_judge_link_no_file_format() {
    let oracle = closure("rayproof-oracle");
    for (room, built) in [
        ("rayproof-cpu", closure("rayproof-cpu")),
        ("rayproof-gpu", closure("rayproof-gpu")),
        ("rayproof-oracle", oracle.clone()),
    ] {
        println!("{room} is built from {} crates", built.len());
        assert!(built.contains(room) && built.contains("glam"), "{room}: {built:?}");
        let found: Vec<_> = built.iter().filter(|name| FORMATS.contains(&name.as_str())).collect();
        assert!(found.is_empty(), "{room} links {found:?}");
    }
    assert!(!oracle.contains("rayproof-tree") && !oracle.contains("obvhs"), "the judge holds the tree that it judges");
    assert_eq!(oracle.len(), ORACLE_CLOSURE, "{oracle:?}");
}

#[test]
fn only_one_room_speaks_to_a_device() {
    let rooms = rooms();
    assert!(rooms[DEVICE_ROOM].built.contains("wgpu") && rooms[DEVICE_ROOM].built.contains("naga"));
    for (name, room) in rooms.iter().filter(|(name, _)| *name != DEVICE_ROOM) {
        let speaks = |dependency: &&String| DEVICE_CRATES.iter().any(|start| dependency.starts_with(start));
        let found: Vec<_> = room.built.iter().filter(speaks).collect();
        assert!(found.is_empty(), "{name} is built from {found:?}");
    }
}

/// The files of a folder and of those in it, by their paths from there, without their endings.
fn stems(folder: &Path, root: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            stems(&path, root, found);
        } else {
            found.insert(path.strip_prefix(root).unwrap().with_extension("").to_str().unwrap().replace('\\', "/"));
        }
    }
}

#[test]
fn every_kernel_has_its_twin_at_its_path() {
    let mut twins = BTreeSet::new();
    let folder = root().join(TWINS);
    stems(&folder, &folder, &mut twins);
    // What holds others together, and tests, are no twins.
    twins.retain(|twin| !["mod", "tests"].contains(&twin.rsplit('/').next().unwrap()));

    let (with, without): (Vec<&str>, Vec<&str>) = rayproof_shaders::FILES
        .iter()
        .map(|(path, _)| *path)
        .partition(|path| !WITHOUT_TWIN.iter().any(|(start, _)| path.starts_with(start)));
    let kernels: BTreeSet<String> = with.iter().map(|path| path.trim_end_matches(".wgsl").to_owned()).collect();
    println!("{} kernels have twins, {} have none", with.len(), without.len());
    assert!(kernels.len() > 20, "{kernels:?}");
    let missing: Vec<_> = kernels.difference(&twins).collect();
    let stray: Vec<_> = twins.difference(&kernels).collect();
    assert!(missing.is_empty(), "without a twin in {TWINS} and not listed: {missing:?}");
    assert!(stray.is_empty(), "in {TWINS} without a kernel: {stray:?}");
    for (start, why) in WITHOUT_TWIN {
        assert!(without.iter().any(|path| path.starts_with(start)), "no kernel is {start}, which has no twin: {why}");
    }
}

#[test]
fn the_top_level_is_tidy() {
    if !root().join(".git").exists() {
        println!("not a clone: nothing tells files of the project from others");
        return;
    }
    // Another user's clone, as in a container, is as good as one's own.
    let output = run("git", &["-c", "safe.directory=*", "ls-files", "-z"]);
    let files = String::from_utf8(output).unwrap();
    let top = files.split_terminator('\0').map(|path| path.split('/').next().unwrap());
    let top: BTreeSet<&str> = top.filter(|name| !name.starts_with('.')).collect();
    let stray: Vec<_> = top.iter().filter(|name| !TOP.contains(name)).collect();
    assert!(stray.is_empty(), "at the top level: {stray:?}");
    assert!(top.contains("Cargo.toml"), "git lists nothing: {files}");
}
