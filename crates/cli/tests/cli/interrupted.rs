//! A run that is killed leaves no HITS and nothing that looks whole; one that is asked to stop leaves nothing at all.

use std::io::Write as _;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::Folder;

const PATIENCE: Duration = Duration::from_secs(60);

/// A run in the middle of its work: some rays have come through stdin, more never come.
fn waiting_run(folder: &Folder) -> Child {
    let mut child = folder.spawn("intersect scene.toml - -o hits.csv --device cpu");
    let stdin = child.stdin.as_mut().unwrap();
    stdin.write_all(super::RAYS.as_bytes()).unwrap();
    stdin.flush().unwrap();
    let started = Instant::now();
    while !folder.names().iter().any(|name| name.contains("hits.csv")) {
        assert!(started.elapsed() < PATIENCE, "the run does not begin to write: {:?}", folder.names());
        assert!(child.try_wait().unwrap().is_none(), "the run has ended");
        sleep(Duration::from_millis(10));
    }
    child
}

#[test]
fn a_killed_run_leaves_no_hits_and_nothing_that_looks_whole() {
    let folder = Folder::with_scene();
    let before = folder.names();
    let mut child = waiting_run(&folder);
    child.kill().unwrap();
    child.wait().unwrap();
    let new: Vec<String> = folder.names().into_iter().filter(|name| !before.contains(name)).collect();
    assert!(!new.contains(&"hits.csv".to_owned()));
    assert!(new.iter().all(|name| name.starts_with('.') && name.ends_with(".partial")), "{new:?}");
    // What a killed run leaves is in nobody's way.
    folder.run("intersect scene.toml rays.csv -o hits.csv --device cpu").expect(0, &[]);
    assert_eq!(super::csv_hits(&folder.read("hits.csv")), super::HITS);
}

/// Sends one signal, and waits for the end.
#[cfg(unix)]
fn stop(child: &mut Child, signal: &str) {
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args([signal, &id]).status().unwrap().success());
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if started.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("{signal} does not stop the run");
        }
        sleep(Duration::from_millis(10));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_ends_though_its_reader_has_stopped_reading() {
    let folder = Folder::with_scene();
    folder.run("rays scene.toml -o many.npy --size 512x512 -q").expect(0, &[]);
    let mut child = folder.spawn("intersect scene.toml many.npy -o - --device cpu");
    // Some hits have come; the pipe is full, and the run waits for room in it.
    let mut first = [0; 1];
    std::io::Read::read_exact(child.stdout.as_mut().unwrap(), &mut first).unwrap();
    sleep(Duration::from_millis(500));
    stop(&mut child, "-TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_cleans_up() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::with_scene();
        let before = folder.names();
        let mut child = waiting_run(&folder);
        // stdin stays open: the run must not wait for it.
        let stdin = child.stdin.take();
        stop(&mut child, signal);
        let output = child.wait_with_output().unwrap();
        drop(stdin);
        super::Ran::of(signal, output).expect(code, &["interrupted"]);
        assert_eq!(folder.names(), before, "{signal}");
    }
}
