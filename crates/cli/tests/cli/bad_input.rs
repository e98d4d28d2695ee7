//! Bad input is exit code 5: the message names the file, the place, what is wrong and what would be right, and no
//! file of hits appears.

use super::{Folder, bytes, npy, npy_rays};

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;
const GOOD: [f32; 6] = [0.0, 0.0, 5.0, 0.0, 0.0, -1.0];

/// Runs `intersect` over these files, and expects a message with these parts.
#[track_caller]
fn refuse((scene, scene_bytes): (&str, &[u8]), (rays, rays_bytes): (&str, &[u8]), parts: &[&str]) {
    let folder = Folder::new();
    folder.write("square.obj", super::SQUARE);
    folder.write(scene, scene_bytes);
    folder.write(rays, rays_bytes);
    let before = folder.names();
    folder.run(&format!("intersect {scene} {rays} -o hits.npy --device cpu")).expect(5, parts);
    assert_eq!(folder.names(), before, "nothing is left behind");
}

#[track_caller]
fn refuse_scene(name: &str, bytes: impl AsRef<[u8]>, parts: &[&str]) {
    refuse((name, bytes.as_ref()), ("rays.csv", super::RAYS.as_bytes()), &[&[name], parts].concat());
}

#[track_caller]
fn refuse_rays(name: &str, bytes: impl AsRef<[u8]>, parts: &[&str]) {
    refuse(("scene.toml", super::SCENE.as_bytes()), (name, bytes.as_ref()), &[&[name], parts].concat());
}

#[test]
fn meshes() {
    refuse_scene("bad.obj", "v 0 0 0\nv 1 nan 0\nv 1 1 inf\nf 1 2 3\n", &["line 2", "first of 2"]);
    refuse_scene("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", &["line 4"]);
    refuse_scene("bad.obj", "v 0 0 0\nv 1 0 0\nv 1 one 0\nf 1 2 3\n", &["line 3"]);
    refuse_scene("bad.stl", "solid\nfacet\n", &[]);
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n";
    refuse_scene("short.ply", ply, &[]);
    refuse_scene("index.ply", format!("{ply}0 1 0\n3 0 1 3\n"), &["3"]);
    refuse_scene("nan.ply", format!("{ply}0 nan 0\n3 0 1 2\n"), &["vertex 2"]);
    refuse_scene("scene.glb", "not a glb", &[]);
    refuse_scene("scene.xyz", "", &[".toml"]);
}

#[test]
fn scene_files_and_spheres() {
    refuse_scene("bad.toml", "[[geometry]]\nspheres = [[0.0, 0.0, 0.0, -1.0]]\n", &["radius", "-1"]);
    refuse_scene(
        "bad.toml",
        "[[geometry]]\nspheres = [[0.0, 0.0, 0.0, 1.0], [0.0, nan, 0.0, 1.0]]\n",
        &["sphere", "1"],
    );
    refuse_scene("bad.toml", "[[geometry]]\nspheres = [[0.0, 0.0, 0.0]]\n", &[]);
    refuse_scene("bad.toml", "[[geometry]]\nmeshes = \"square.obj\"\n", &["meshes"]);
    refuse_scene("bad.toml", "[[geometry]\n", &["line 1"]);
    refuse_scene(
        "bad.toml",
        "[[geometry]]\nmesh = \"square.obj\"\n[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 1]\n",
        &["camera"],
    );
    let folder = Folder::with_scene();
    folder.write("gone.toml", "[[geometry]]\nmesh = \"gone.obj\"\n");
    folder.run("intersect gone.toml rays.csv -o hits.npy").expect(5, &["gone.obj"]);
    folder.run("intersect absent.ply rays.csv -o hits.npy").expect(5, &["absent.ply", "opened"]);
    folder.run("intersect scene.toml absent.npy -o hits.npy").expect(5, &["absent.npy", "opened"]);
    folder.run("render absent.ply -o picture.png").expect(5, &["absent.ply"]);
    folder.run("rays absent.ply -o new.npy").expect(5, &["absent.ply"]);
}

#[test]
fn directories_and_empty_names() {
    let folder = Folder::with_scene();
    std::fs::create_dir(folder.path("folder.obj")).unwrap();
    std::fs::create_dir(folder.path("folder.npy")).unwrap();
    for (line, part) in [
        ("intersect folder.obj rays.csv -o hits.npy", "folder.obj: cannot be opened: "),
        ("intersect scene.toml folder.npy -o hits.npy", "folder.npy"),
        ("intersect '' rays.csv -o hits.npy", "'': the file's ending: there is none"),
        ("intersect scene.toml '' -o hits.npy", "'': name: it has no ending"),
        ("rays '' -o new.npy", "'': "),
        ("render '' -o new.png", "'': "),
        ("info ''", "'': "),
        ("intersect - rays.csv -o hits.npy", "-: stdin: a scene is not read from stdin"),
        ("info -", "give a scene: .obj, "),
        ("info folder.obj", "folder.obj"),
        ("report --quick --device cpu --scene ''", "'': "),
    ] {
        folder.run(line).expect(5, &[part]);
    }
    // No name to write to is a command that was typed wrong.
    folder.run("intersect scene.toml rays.csv -o ''").expect(2, &["--output"]);
}

#[test]
fn rays_that_are_none() {
    for (bad, what) in [
        ([NAN, 0.0, 0.0, 0.0, 0.0, 1.0], "origin"),
        ([0.0, 0.0, -INF, 0.0, 0.0, 1.0], "origin"),
        ([0.0, 0.0, 0.0, 0.0, NAN, 1.0], "direction"),
        ([0.0, 0.0, 0.0, INF, 0.0, 1.0], "direction"),
        ([1.0, 2.0, 3.0, 0.0, -0.0, 0.0], "zero"),
    ] {
        refuse_rays("bad.npy", npy_rays(&[GOOD, bad, GOOD, bad, bad]), &["row 1", "first of 3", what]);
    }
    let range = [[0.0, 0.0, 5.0, 0.0, 0.0, -1.0, -INF, INF], [0.0, 0.0, 5.0, 0.0, 0.0, -1.0, 2.0, 1.0]];
    refuse_rays("bad.npy", npy("'<f4'", "(2, 8)", &bytes(range.as_flattened())), &["row 1", "t_min <= t_max"]);
    refuse_rays("bad.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,0,0,1\n\n0,0,0,0,0,0\n", &["line 4", "zero"]);
}

#[test]
fn rays_in_the_wrong_shape() {
    refuse_rays("bad.npy", npy("'<f4'", "(2, 3)", &[0; 24]), &["(2, 3)", "(N, 6)"]);
    refuse_rays("bad.npy", npy("'<f4'", "(12,)", &[0; 48]), &["(12,)", "(N, 6)"]);
    refuse_rays("bad.npy", npy("'<i4'", "(1, 6)", &[0; 24]), &["<i4", "float32"]);
    refuse_rays("bad.npy", npy("'>f4'", "(1, 6)", &[0; 24]), &[">f4", "little-endian"]);
    refuse_rays("bad.npy", npy("'<f4'", "(10, 6)", &[0; 239]), &["10 rows", "239"]);
    refuse_rays("bad.npy", npy("'<f4'", "(1, 6)", &[0; 25]), &["1 rows", "25"]);
    refuse_rays("bad.npy", "no array", &["magic"]);
    refuse_rays("bad.npy", "", &[]);
    refuse_rays("bad.csv", "", &["header"]);
    refuse_rays("bad.csv", "0,0,0,0,0,1\n", &["line 1"]);
    refuse_rays("bad.csv", "ox,oy,oz,dx,dy,dz,t_min\n", &["t_max"]);
    refuse_rays("bad.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,0,0\n", &["line 2", "5"]);
    refuse_rays("bad.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,0,0,1\n0,0,0,0,x,1\n", &["line 3", "dy", "x"]);
    refuse_rays("bad.txt", super::RAYS, &[".csv"]);
}

#[test]
fn a_bad_ray_after_many_good_ones_leaves_the_older_hits_as_they_were() {
    let folder = Folder::with_scene();
    let mut rays = vec![GOOD; (1 << 20) + 10];
    rays[1 << 20][0] = NAN;
    folder.write("late.npy", npy_rays(&rays));
    folder.write("hits.npy", "an older file");
    let before = folder.names();
    folder.run("intersect scene.toml late.npy -o hits.npy --device cpu").expect(5, &["late.npy", "row 1048576"]);
    assert_eq!(folder.read("hits.npy"), b"an older file");
    assert_eq!(folder.names(), before);
}

#[test]
fn invalid_rays_become_misses_and_are_counted_on_request() {
    let folder = Folder::with_scene();
    folder.write("some.csv", "ox,oy,oz,dx,dy,dz\n0.75,0.25,1,0,0,-1\n0,0,nan,0,0,1\n0,0,0,0,0,0\n3,0,5,0,0,-2\n");
    let ran = folder.run("intersect scene.toml some.csv -o hits.csv --invalid miss --device cpu --json --check 9");
    let json = ran.expect(0, &["2 invalid"]).json();
    assert_eq!(json["invalid_rays"], 2);
    assert_eq!((&json["rays"], &json["hits"]), (&4.into(), &2.into()));
    let hits = super::csv_hits(&folder.read("hits.csv"));
    assert_eq!(hits, [super::HITS[0], super::HITS[3], super::HITS[3], super::HITS[2]]);
}

#[test]
fn what_cannot_be_written_is_exit_code_1() {
    let folder = Folder::with_scene();
    folder.run("intersect scene.toml rays.csv -o absent/hits.npy --device cpu").expect(1, &["absent/hits.npy"]);
    folder.run("rays scene.toml -o absent/rays.npy").expect(1, &["absent/rays.npy"]);
    folder.run("render scene.toml -o absent/picture.png --device cpu --size 8x8").expect(1, &["absent/picture.png"]);
}
