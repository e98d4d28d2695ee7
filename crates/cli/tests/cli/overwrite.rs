//! An output that is one of the inputs is refused, and the input keeps its bytes.

use super::{Folder, npy, npy_rays};

/// A folder with a scene that names two tables and a mesh.
fn folder() -> Folder {
    let folder = Folder::with_scene();
    folder.write("beads.npy", npy("'<f4'", "(1, 4)", &super::bytes(&[0.0, 0.0, 0.0, 1.0])));
    folder.write("beads.csv", "x,y,z,r\n0,0,5,1\n");
    folder.write("rays.npy", npy_rays(&[[0.0, 0.0, 9.0, 0.0, 0.0, -1.0]]));
    let tables = "[[geometry]]\nspheres = \"beads.npy\"\n[[geometry]]\nspheres = \"beads.csv\"\n";
    folder.write("all.toml", format!("{}{tables}", super::SCENE));
    folder
}

/// Expects exit code 2, both names in the message, and every file as it was.
#[track_caller]
fn refuse(folder: &Folder, line: &str, names: [&str; 2]) {
    let bytes = || folder.names().iter().filter(|n| folder.path(n).is_file()).map(|n| folder.read(n)).collect();
    let before: (Vec<String>, Vec<Vec<u8>>) = (folder.names(), bytes());
    folder.run(line).expect(2, &[&format!("{} is the input {}", names[0], names[1])]);
    assert!(before == (folder.names(), bytes()), "rayproof {line}: the files have changed");
}

#[test]
fn an_output_that_is_an_input_is_refused() {
    let folder = folder();
    refuse(&folder, "intersect all.toml rays.npy -o rays.npy --device cpu", ["rays.npy", "rays.npy"]);
    refuse(&folder, "intersect all.toml rays.npy -o beads.npy --device cpu", ["beads.npy", "beads.npy"]);
    refuse(&folder, "intersect all.toml rays.npy -o beads.csv --query any", ["beads.csv", "beads.csv"]);
    refuse(&folder, "rays all.toml -o beads.npy --size 8x8", ["beads.npy", "beads.npy"]);
    refuse(&folder, "rays all.toml -o beads.csv --kind incoherent --count 9", ["beads.csv", "beads.csv"]);
    // Another table of the same kind is nobody's input.
    folder.write("other.npy", "old");
    folder.run("intersect all.toml rays.npy -o other.npy --device cpu").expect(0, &[]);
    assert_ne!(folder.read("other.npy"), b"old");
}

#[test]
fn another_spelling_is_the_same_file() {
    let folder = folder();
    std::fs::create_dir(folder.path("sub")).unwrap();
    refuse(&folder, "intersect all.toml rays.npy -o sub/../rays.npy --device cpu", ["sub/../rays.npy", "rays.npy"]);
    let whole = folder.path("beads.npy").display().to_string();
    refuse(&folder, &format!("rays ./all.toml -o {whole} --size 8x8"), [&whole, "./beads.npy"]);
}

#[cfg(unix)]
#[test]
fn a_link_is_the_file_that_it_leads_to() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    for (file, link) in [("rays.npy", "link.npy"), ("all.toml", "scene.csv"), ("square.obj", "mesh.png")] {
        symlink(folder.path(file), folder.path(link)).unwrap();
    }
    refuse(&folder, "intersect all.toml rays.npy -o link.npy --device cpu", ["link.npy", "rays.npy"]);
    refuse(&folder, "intersect all.toml link.npy -o rays.npy --device cpu", ["rays.npy", "link.npy"]);
    refuse(&folder, "rays all.toml -o scene.csv --size 8x8", ["scene.csv", "all.toml"]);
    refuse(&folder, "render all.toml -o mesh.png --size 8x8 --device cpu", ["mesh.png", "square.obj"]);
    refuse(&folder, "render square.obj -o mesh.png --size 8x8 --device cpu", ["mesh.png", "square.obj"]);
}
