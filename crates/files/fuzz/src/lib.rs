//! What the fuzz targets do with bytes that may be anything: read them as a file of some format, and trace rays through what was
//! accepted. Nothing may panic, take longer than a second, or reserve more than the file is worth.

mod ask;
mod memory;

use std::path::Path;
use std::sync::{Once, OnceLock};
use std::{fs, panic};

use rayproof::files::{InvalidRays, Origin, RayReader, Survey, load_at};
use rayproof::scene::Ray;
use tempfile::TempDir;

/// The folder of the files, in memory where the system has such.
fn folder() -> &'static Path {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    FOLDER
        .get_or_init(|| {
            let shared = Path::new("/dev/shm");
            let folder = if shared.is_dir() { tempfile::tempdir_in(shared) } else { tempfile::tempdir() };
            let folder = folder.expect("a temporary folder");
            // What scene files of the seeds name.
            for (name, text) in [("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), ("a.csv", "x,y,z,r\n0,0,0,1\n")] {
                fs::write(folder.path().join(name), text).expect("a file");
            }
            folder
        })
        .path()
}

/// Reads a scene and asks for hits.
pub fn scene(name: &str, bytes: &[u8]) {
    let path = folder().join(name);
    fs::write(&path, bytes).expect("a file");
    load(&path, bytes);
}

/// As [`scene`], of a table of spheres that a scene file names.
pub fn spheres(name: &str, bytes: &[u8]) {
    fs::write(folder().join(name), bytes).expect("a file");
    let path = folder().join("spheres.toml");
    if !path.exists() {
        fs::write(&path, format!("[[geometry]]\nspheres = \"{name}\"\n")).expect("a file");
    }
    load(&path, bytes);
}

fn load(path: &Path, bytes: &[u8]) {
    // Some move the scene: the last byte tells.
    let origin = match bytes.last() {
        Some(0..=31) => Origin::Auto,
        Some(32..=63) => Origin::At([1e9, -0.1, 3.0]),
        _ => Origin::Own,
    };
    let loaded = memory::within(bytes.len(), || load_at(path, origin));
    match loaded {
        Ok(loaded) => {
            loaded.scene.geometries().iter().for_each(|geometry| { let _ = Survey::of(geometry); });
            ask::all(&loaded.scene, bytes);
        }
        Err(error) => short(&error.to_string()),
    }
}

/// Panics within the parquet crate are its readers' errors here: the reader catches them. The fuzzer ends at any other.
fn forgive_parquet() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !panic.location().is_some_and(|at| at.file().contains("/parquet-") || at.file().contains("/arrow-")) {
                before(panic);
            }
        }));
    });
}

/// Reads a table of rays: as a whole, and its middle.
pub fn rays(name: &str, bytes: &[u8]) {
    forgive_parquet();
    let path = folder().join(name);
    fs::write(&path, bytes).expect("a file");
    let read = |part: bool, invalid: InvalidRays| {
        let mut reader = RayReader::open(&path, None, invalid)?;
        if part {
            let rows = reader.count()?.unwrap_or(0);
            reader.select(rows / 3..rows - rows / 3)?;
        }
        let (mut rays, mut all) = (Vec::new(), Vec::<Ray>::new());
        // A few numbers in a file can stand for millions: no more of them is of interest.
        while all.len() < 1 << 18 && reader.next_batch(&mut rays, 1 << 12)? > 0 {
            all.extend(&rays);
        }
        Ok::<_, rayproof::files::Error>(all)
    };
    for (part, invalid) in [(false, InvalidRays::Error), (true, InvalidRays::Miss)] {
        match memory::within(bytes.len(), || read(part, invalid)) {
            Ok(rays) if invalid == InvalidRays::Error => assert!(rays.iter().all(|ray| ray.fault().is_none())),
            Ok(_) => {}
            Err(error) => short(&error.to_string()),
        }
    }
}

/// A message is for people to read: it is of one line and no longer than it must be, whatever is in the file.
fn short(message: &str) {
    let folder = folder().display().to_string();
    let length = message.replace(&folder, "").chars().count();
    // A place, a quotation and a remedy, the longest of them 240.
    assert!(length <= 500, "a message of {length} characters: {message}");
    assert!(!message.chars().any(char::is_control), "a message with control characters: {message:?}");
}
