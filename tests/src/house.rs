//! Do the rooms know of each other only what the README's drawing says, and is the top level as tidy as it says?
#![expect(clippy::unwrap_used, reason = "a test")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Each room, and the rooms that it is built from. A new room is entered here and in the README.
const ROOMS: [(&str, &[&str]); 10] = [
    ("rayproof-scene", &[]),
    ("rayproof-gpu", &["rayproof-scene"]),
    ("rayproof-cpu", &["rayproof-scene"]),
    ("rayproof", &["rayproof-cpu", "rayproof-gpu", "rayproof-scene"]),
    ("rayproof-oracle", &["rayproof-scene"]),
    ("rayproof-picture", &["rayproof-oracle", "rayproof-scene"]),
    ("rayproof-report", &["rayproof", "rayproof-gpu", "rayproof-oracle"]),
    ("rayproof-cli", &["rayproof", "rayproof-oracle", "rayproof-picture", "rayproof-report"]),
    ("rayproof-viewer", &["rayproof", "rayproof-oracle", "rayproof-picture"]),
    ("rayproof-tests", &[]),
];

/// The only room that speaks to a device, and what it does that with.
const DEVICE_ROOM: &str = "rayproof-gpu";
const DEVICE_CRATES: [&str; 4] = ["wgpu", "naga", "ash", "spirv"];

/// What is at the top level beside dot-files.
const TOP: [&str; 8] =
    ["Cargo.lock", "Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md", "crates", "shaders", "tests"];

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
    let rooms = rooms();
    for name in ["rayproof-scene", "rayproof-gpu", "rayproof-cpu", "rayproof-oracle"] {
        let found = ours(&rooms[name].tested);
        assert!(found.is_empty(), "the tests of {name} use {found:?}");
    }
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
