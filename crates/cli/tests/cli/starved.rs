//! A driver stack that finds no memory takes nothing with it: the CPU engine answers, and what is the matter is said.

use std::process::Command;

use super::{Folder, Ran, csv_hits};

/// A command line under a limit on its address space, in KiB.
fn starved(folder: &Folder, limit: u32, line: &str) -> Ran {
    let script = format!("ulimit -v {limit} && exec \"$@\"");
    let mut command = Command::new("bash");
    command.args(["-c", &script, "bash"]).arg(env!("CARGO_BIN_EXE_rayproof")).args(line.split_whitespace());
    command.current_dir(folder.0.path());
    Ran::of(line, command.output().unwrap())
}

/// Mesa panics wgpu at some of these, crashes at others, and runs out of memory at the rest.
const LIMITS: [u32; 6] = [285_000, 300_000, 330_000, 400_000, 450_000, 900_000];

#[test]
fn where_memory_is_limited_the_cpu_engine_answers_and_says_why() {
    let folder = Folder::with_scene();
    folder.run("intersect scene.toml rays.csv -o right.csv --device cpu").expect(0, &[]);
    for limit in LIMITS {
        let line = "intersect scene.toml rays.csv -o hits.csv --device";
        starved(&folder, limit, &format!("{line} auto")).expect(0, &["CPU engine", "could not be used", "ulimit -v"]);
        assert_eq!(csv_hits(&folder.read("hits.csv")), csv_hits(&folder.read("right.csv")), "{limit}");
        starved(&folder, limit, &format!("{line} gpu")).expect(1, &["out of memory", "ulimit -v"]);
        for ending in ["", " --json"] {
            let listed = starved(&folder, limit, &format!("devices{ending}")).expect(0, &[]);
            let listed = String::from_utf8(listed.stdout).unwrap();
            assert!(listed.contains("CPU engine") && listed.contains("out of memory"), "{limit}: {listed}");
        }
    }
}
