//! Does the example in the README do what it says, in a crate that copies it and has nothing of this workspace but the library?
#![expect(clippy::unwrap_used, reason = "a test")]

use std::fs;
use std::path::Path;
use std::process::Command;

/// How many crates the library is built from without its default features, itself included, as the README says.
const SMALL: usize = 23;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The first block of Rust in the README.
fn example() -> String {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let (_, rest) = readme.split_once("```rust\n").unwrap();
    rest.split_once("```\n").unwrap().0.to_owned()
}

/// Runs cargo on the reader's crate, without a network; returned is what it prints.
fn cargo(folder: &Path, arguments: &[&str]) -> String {
    let mut cargo = Command::new(env!("CARGO"));
    let output =
        cargo.args(arguments).arg("--offline").current_dir(folder).env_remove("CARGO_TARGET_DIR").output().unwrap();
    assert!(output.status.success(), "{cargo:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_example_runs_in_a_fresh_crate_that_copies_it() {
    // Kept from run to run, so that only what has changed is built.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reader");
    fs::create_dir_all(folder.join("src")).unwrap();
    let manifest = format!(
        "[package]\nname = \"reader\"\nedition = \"2024\"\n\n[workspace]\n\n[profile.dev]\ndebug = false\n\n\
         [dependencies]\nrayproof = {{ path = {:?}, default-features = false }}\n",
        root().join("crates/rayproof")
    );
    fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    fs::write(folder.join("src/main.rs"), example()).unwrap();
    // The versions that the workspace is tested with.
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    cargo(&folder, &["run", "--quiet"]);

    let tree =
        cargo(&folder, &["tree", "--package", "rayproof", "--edges", "normal", "--prefix", "none", "--format", "{p}"]);
    let mut crates: Vec<&str> = tree.lines().filter_map(|line| line.split_whitespace().next()).collect();
    crates.sort_unstable();
    crates.dedup();
    println!("the library alone is built from {} crates", crates.len());
    assert_eq!(crates.len(), SMALL, "{crates:?}");
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(
        readme.contains(&format!("this builds from {SMALL} crates")),
        "the README says another number than {SMALL}"
    );
}
