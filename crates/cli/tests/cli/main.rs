//! The command line, as other people's scripts see it: arguments, files, streams, exit codes.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests, which say how much they compared")]

mod bad_input;
mod check;
mod engines;
mod formats;
mod interrupted;
mod kept;
mod overwrite;
mod places;
mod rays;
mod render;
mod report;
#[cfg(target_os = "linux")]
mod starved;
mod streams;
mod usage;
mod viewer;

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use tempfile::TempDir;

/// A file that is shipped.
fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data").join(name)
}

/// An empty folder to run in, so that messages name files as they were typed.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A folder with `square.obj`, `scene.toml` and `rays.csv`, and the answers in [`HITS`].
    fn with_scene() -> Self {
        let folder = Self::new();
        folder.write("square.obj", SQUARE);
        folder.write("scene.toml", SCENE);
        folder.write("rays.csv", RAYS);
        folder
    }

    /// A folder with the sample scene.
    fn with_sample() -> Self {
        let folder = Self::new();
        for name in ["knot.obj", "sample.toml"] {
            folder.write(name, fs::read(shipped(name)).unwrap());
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The names of all files, sorted.
    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(self.0.path()).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rayproof"));
        // As a shell has it, '' is an empty word.
        command
            .args(line.split_whitespace().map(|word| if word == "''" { "" } else { word }))
            .current_dir(self.0.path());
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs a command line to its end.
    fn run(&self, line: &str) -> Ran {
        Ran::of(line, self.command(line).output().unwrap())
    }

    /// Runs a command line with these bytes on stdin.
    fn run_with(&self, line: &str, stdin: &[u8]) -> Ran {
        let mut child = self.spawn(line);
        let mut pipe = child.stdin.take().unwrap();
        let stdin = stdin.to_owned();
        let writer = std::thread::spawn(move || {
            // A run that fails early closes its end.
            let _ = pipe.write_all(&stdin);
        });
        let output = child.wait_with_output().unwrap();
        writer.join().unwrap();
        Ran::of(line, output)
    }

    /// Starts a command line with stdin open.
    fn spawn(&self, line: &str) -> Child {
        self.command(line).stdin(Stdio::piped()).spawn().unwrap()
    }
}

/// What a run left behind.
struct Ran {
    line: String,
    code: Option<i32>,
    stdout: Vec<u8>,
    stderr: String,
}

impl Ran {
    fn of(line: &str, output: Output) -> Self {
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(!stderr.contains("panicked"), "rayproof {line}\n{stderr}");
        Self { line: line.to_owned(), code: output.status.code(), stdout: output.stdout, stderr }
    }

    /// Asserts the exit code, and that stderr holds all of these.
    #[track_caller]
    fn expect(self, code: i32, parts: &[&str]) -> Self {
        let Self { line, stderr, .. } = &self;
        assert_eq!(self.code, Some(code), "rayproof {line}\n{stderr}");
        for part in parts {
            assert!(stderr.contains(part), "rayproof {line}\nno {part:?} in\n{stderr}");
        }
        self
    }

    fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.stdout)
            .unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&self.stdout)))
    }
}

/// Two triangles, as one polygon: (0 1 2) and (0 2 3).
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

const SCENE: &str = "\
[[geometry]]
mesh = \"square.obj\"
[[geometry]]
spheres = [[9.0, 9.0, 9.0, 0.5], [3.0, 0.0, 0.0, 1.0]]
";

const RAYS: &str = "\
ox,oy,oz,dx,dy,dz
0.75,0.25,1,0,0,-1
0.25,0.75,-2,0,0,4
3,0,5,0,0,-2
3,0,5,0,0,2
3,0,0,0.5,0,0
";

/// t, u, v, geometry, primitive.
type Hit = (f32, f32, f32, u32, u32);

/// The answers to [`RAYS`], by hand.
const HITS: [Hit; 5] = [
    (1.0, 0.5, 0.25, 0, 0),
    (0.5, 0.25, 0.5, 0, 1),
    (2.0, 0.0, 0.0, 1, 1),
    (f32::INFINITY, 0.0, 0.0, u32::MAX, u32::MAX),
    (2.0, 0.0, 0.0, 1, 1),
];

/// An `.npy` file, version 1.0.
fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let mut header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let length = u16::try_from(header.len()).unwrap();
    [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..], header.as_bytes(), data].concat()
}

fn bytes(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Rows of six values as an `.npy` file.
fn npy_rays(rows: &[[f32; 6]]) -> Vec<u8> {
    npy("'<f4'", &format!("({}, 6)", rows.len()), &bytes(rows.as_flattened()))
}

/// The data of an `.npy` file, without its header.
fn npy_data(file: &[u8]) -> &[u8] {
    &file[10 + usize::from(u16::from_le_bytes([file[8], file[9]]))..]
}

/// The rows of a CSV file of closest hits.
fn csv_hits(file: &[u8]) -> Vec<Hit> {
    let text = std::str::from_utf8(file).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("t,u,v,geometry,primitive"));
    let row = |line: &str| {
        let f: Vec<&str> = line.split(',').collect();
        assert_eq!(f.len(), 5, "{line}");
        (
            f[0].parse().unwrap(),
            f[1].parse().unwrap(),
            f[2].parse().unwrap(),
            f[3].parse().unwrap(),
            f[4].parse().unwrap(),
        )
    };
    lines.map(row).collect()
}
