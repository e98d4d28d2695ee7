use std::path::Path;

use glam::Vec3;
use tempfile::TempDir;

use super::{message, write};
use crate::{Error, LoadedScene, Origin, load, load_at};
use rayproof_scene::{Camera, Geometry, Sphere};

/// A folder with a scene file and what it may name.
fn folder(text: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), text).unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    std::fs::write(folder.path().join("sub/tri.OBJ"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    std::fs::write(folder.path().join("beads.csv"), "x,y,z,r\n1,2,3,4\n").unwrap();
    let row: Vec<u8> = [5.0_f32, 6.0, 7.0, 8.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    std::fs::write(folder.path().join("beads.npy"), write::npy("<f4", "False", "(1, 4)", &row)).unwrap();
    std::fs::write(folder.path().join("bad.csv"), "x,y,z,r\n1,2,3,-4\n").unwrap();
    folder
}

fn scene(text: &str) -> Result<LoadedScene, Error> {
    load(&folder(text).path().join("scene.toml"))
}

/// What is said, without the name of the folder.
#[track_caller]
fn said(text: &str) -> String {
    let folder = folder(text);
    message(load(&folder.path().join("scene.toml"))).replace(&format!("{}/", folder.path().display()), "")
}

fn sphere(x: f32, y: f32, z: f32, radius: f32) -> Sphere {
    Sphere { center: Vec3::new(x, y, z), radius }
}

#[test]
fn geometries_are_numbered_as_in_the_file() {
    let loaded = scene(
        "[[geometry]]\nspheres = [[0.0, 1, 0.5, 0.1], [0, 0, 0, 0]]\n[[geometry]]\nmesh = \"sub/tri.OBJ\"\n\
         [[geometry]]\nspheres = \"beads.npy\"\n[[geometry]]\nspheres = \"beads.csv\"\n[[geometry]]\nspheres = []\n\
         [camera]\neye = [0, 1, 5]\ntarget = [0, 1, 0]\nup = [0, 1, 0]\nfov_y = 40\n",
    )
    .unwrap();
    let [Geometry::Spheres(inline), Geometry::Mesh(mesh), Geometry::Spheres(npy), Geometry::Spheres(csv), last] =
        loaded.scene.geometries()
    else {
        panic!("{:?}", loaded.scene)
    };
    assert_eq!(*inline, [sphere(0.0, 1.0, 0.5, 0.1), sphere(0.0, 0.0, 0.0, 0.0)]);
    assert_eq!((mesh.vertices.len(), &mesh.triangles[..]), (3, &[[0, 1, 2]][..]));
    assert_eq!((&npy[..], &csv[..]), (&[sphere(5.0, 6.0, 7.0, 8.0)][..], &[sphere(1.0, 2.0, 3.0, 4.0)][..]));
    assert!(last.is_empty());
    let camera = Camera { eye: Vec3::new(0.0, 1.0, 5.0), target: Vec3::Y, up: Vec3::Y, fov_y: 40.0 };
    assert_eq!(loaded.camera, Some(camera));
}

#[test]
fn a_mesh_alone_is_geometry_0_and_nothing_is_an_empty_scene() {
    let folder = folder("");
    let loaded = load(&folder.path().join("sub/tri.OBJ")).unwrap();
    assert_eq!((loaded.scene.geometries().len(), loaded.scene.len(), loaded.camera), (1, 1, None));
    assert_eq!(loaded.sources, [folder.path().join("sub/tri.OBJ")]);
    let sources = vec![folder.path().join("scene.toml")];
    let loaded = load(&sources[0]).unwrap();
    assert_eq!(loaded, LoadedScene { sources, ..LoadedScene::default() });
}

#[test]
fn the_files_that_a_scene_was_read_from_are_listed() {
    let folder = folder(
        "[[geometry]]\nmesh = \"sub/tri.OBJ\"\n[[geometry]]\nspheres = []\n[[geometry]]\nspheres = \"beads.csv\"\n",
    );
    let sources = load(&folder.path().join("scene.toml")).unwrap().sources;
    assert_eq!(sources, ["scene.toml", "sub/tri.OBJ", "beads.csv"].map(|name| folder.path().join(name)));
}

#[test]
fn missing_files_are_named() {
    for (text, missing) in
        [("[[geometry]]\nmesh = \"none.ply\"", "none.ply"), ("[[geometry]]\nspheres = \"none.npy\"", "none.npy")]
    {
        let error = scene(text).unwrap_err();
        assert!(matches!(&error, Error::Open { path, .. } if path.ends_with(missing)), "{error:?}");
    }
    for name in ["none.obj", "none.ply", "none.stl", "none.gltf", "none.glb", "none.toml", "none.TOML"] {
        let error = load(Path::new(name)).unwrap_err();
        assert!(matches!(&error, Error::Open { path, .. } if path == Path::new(name)), "{error:?}");
        assert!(error.to_string().starts_with(&format!("{name}: cannot be opened: ")), "{error}");
    }
}

#[test]
fn unknown_endings_are_named() {
    let known = "give a scene: .obj, .ply, .stl, .gltf, .glb or .toml";
    assert_eq!(
        message(load(Path::new("a.fbx"))),
        format!("a.fbx: the file's ending: `.fbx` is not one we read; {known}")
    );
    assert_eq!(message(load(Path::new("a"))), format!("a: the file's ending: there is none; {known}"));
    let stdin = "a scene is not read from stdin: the ending of its name says what it is, and it names other files";
    assert_eq!(message(load(Path::new("-"))), format!("-: stdin: {stdin}; {known}"));
    for (text, expected) in [
        (
            "[[geometry]]\nmesh = \"a.npy\"",
            "a.npy: the file's ending: `.npy` is not one we read; give a mesh: .obj, .ply, .stl, .gltf or .glb",
        ),
        (
            "[[geometry]]\nspheres = \"a.obj\"",
            "a.obj: the file's ending: `.obj` is not one we read; give a table of spheres: .npy or .csv",
        ),
        (
            "[[geometry]]\nmesh = \"b.toml\"",
            "scene.toml: geometry 0 (counting from 0): mesh = \"b.toml\" is a scene file; list that file's geometries here",
        ),
    ] {
        assert_eq!(said(text), expected);
    }
}

#[test]
fn what_is_not_a_scene_file_is_named() {
    let format =
        "give [[geometry]] with `mesh`, `spheres` or `triangles`, and [camera] with `eye`, `target`, `up` and `fov_y`";
    let one_of = "give one of: mesh = \"a path\", spheres = \"a path\", spheres = [[x, y, z, radius], ..], \
                  triangles = [[ax, ay, az, bx, by, bz, cx, cy, cz], ..]";
    for (text, expected) in [
        (
            "\n[[geometry]]\nmehs = \"a.ply\"",
            format!("line 3: unknown field `mehs`, expected one of `mesh`, `spheres`, `triangles`; {format}"),
        ),
        (
            "[[geometries]]\nmesh = \"a.ply\"",
            format!("line 1: unknown field `geometries`, expected one of `geometry`, `camera`, `origin`; {format}"),
        ),
        (
            "[camera]\neye = [0, 0, 1]\nroll = 3",
            format!("line 3: unknown field `roll`, expected one of `eye`, `target`, `up`, `fov_y`; {format}"),
        ),
        (
            "[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 0]\nup = [0, 1, 0]",
            format!("line 1: missing field `fov_y`; {format}"),
        ),
        ("\n[camera]\neye = [0, 0]", format!("line 3: invalid length 2, expected an array of length 3; {format}")),
        ("a = = 1", format!("line 1: extra `=`, expected nothing; {format}")),
        (
            "[[geometry]]",
            format!("geometry 0 (counting from 0): it has no `mesh`, no `spheres` and no `triangles`; {one_of}"),
        ),
        (
            "[[geometry]]\nspheres = []\n[[geometry]]\nmesh = \"a.ply\"\nspheres = []",
            format!(
                "geometry 1 (counting from 0): it has more than one of `mesh`, `spheres` and `triangles`; {one_of}"
            ),
        ),
        (
            "[[geometry]]\nspheres = 3",
            format!("geometry 0 (counting from 0): `spheres` is neither a path nor rows; {one_of}"),
        ),
        (
            "[[geometry]]\ntriangles = \"a.obj\"",
            format!("geometry 0 (counting from 0): `triangles` are no rows; {one_of}"),
        ),
    ] {
        assert_eq!(said(text), format!("scene.toml: {expected}"));
    }
    let folder = folder("");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, b"# fine\n\xff").unwrap();
    assert!(message(load(&path)).ends_with(&format!("scene.toml: line 2: this is not UTF-8; {format}")));
}

#[test]
fn bad_spheres_are_named() {
    let finite = "give x, y, z and radius as finite numbers within the range of f32";
    for (rows, expected) in [
        (
            "[0, 0, 0, 1], [0, 0, 0, -1], [0, 0, 0, -2]",
            "sphere 1 (counting from 0): the radius -1.0 is negative (the first of 2); give a radius of zero or more"
                .into(),
        ),
        (
            "[nan, 0, 0, 1]",
            format!("sphere 0 (counting from 0): the sphere (NaN, 0.0, 0.0, 1.0) is not finite; {finite}"),
        ),
        (
            "[0, 0, 0, inf]",
            format!("sphere 0 (counting from 0): the sphere (0.0, 0.0, 0.0, inf) is not finite; {finite}"),
        ),
        (
            "[1e39, 0, 0, 1]",
            format!("sphere 0 (counting from 0): the sphere (inf, 0.0, 0.0, 1.0) is not finite; {finite}"),
        ),
        ("[0, 0, 0]", "sphere 0 (counting from 0): `[0, 0, 0]` is not four numbers; give [x, y, z, radius]".into()),
        ("[0, 0, 0, 1], 7", "sphere 1 (counting from 0): `7` is not four numbers; give [x, y, z, radius]".into()),
        (
            "[0, 0, 0, \"1\"]",
            "sphere 0 (counting from 0): `\"1\"` is no number, and no hexadecimal float that is an f32; \
             give [x, y, z, radius]"
                .into(),
        ),
    ] {
        assert_eq!(said(&format!("[[geometry]]\nspheres = [{rows}]")), format!("scene.toml: geometry 0, {expected}"));
    }
    let expected = "bad.csv: line 2: the radius -4.0 is negative; give a radius of zero or more";
    assert_eq!(said("[[geometry]]\nspheres = \"bad.csv\""), expected);
}

#[test]
fn triangles_and_hexadecimal_floats_stand_in_the_file() {
    let text =
        "[[geometry]]\ntriangles = [[0, 0, 0, \"0x1p-149\", 0, 0, 0, \"-0x1.8p+3\", 0], [0, 0, 0, 1, 0, 0, 0, 1, 0]]";
    let folder = folder(text);
    let scene = load(&folder.path().join("scene.toml")).unwrap().scene;
    let Geometry::Mesh(mesh) = &scene.geometries()[0] else { panic!("{scene:?}") };
    assert_eq!(mesh.triangle(0).b.x.to_bits(), 1);
    assert_eq!((mesh.triangle(0).c.y, mesh.triangle(1).b), (-12.0, Vec3::X));
    let nine = "give [ax, ay, az, bx, by, bz, cx, cy, cz]";
    for (row, expected) in [
        ("[0, 0, 0]", format!("`[0, 0, 0]` is not nine numbers; {nine}")),
        (
            "[0, 0, 0, 1, 0, 0, 0, 1, \"0x1.00000001p0\"]",
            format!("`\"0x1.00000001p0\"` is no number, and no hexadecimal float that is an f32; {nine}"),
        ),
    ] {
        let expected = format!("scene.toml: geometry 0, triangle 0 (counting from 0): {expected}");
        assert_eq!(said(&format!("[[geometry]]\ntriangles = [{row}]")), expected);
    }
    assert!(said("[[geometry]]\ntriangles = [[0, 0, 0, nan, 0, 0, 0, 1, 0]]").contains("triangle 0"));
}

#[test]
fn bad_cameras_are_named() {
    for ((eye, target, up, fov_y), expected) in [
        (("[0, 0, 1]", "[0, 0, 1]", "[0, 1, 0]", "40"), "eye and target are the same point; give two points"),
        // The same point in f32.
        (("[1, 0, 0]", "[1.00000001, 0, 0]", "[0, 1, 0]", "40"), "eye and target are the same point; give two points"),
        (
            ("[0, 3, 0]", "[0, 0, 0]", "[0, 1, 0]", "40"),
            "up is along the line of sight, or zero; give an up that is not",
        ),
        (
            ("[1, 2, 3]", "[0, 0, 0]", "[2, 4, 6]", "40"),
            "up is along the line of sight, or zero; give an up that is not",
        ),
        (
            ("[1, 2, 3]", "[0, 0, 0]", "[0, 0, 0]", "40"),
            "up is along the line of sight, or zero; give an up that is not",
        ),
        (("[0, 0, 1]", "[0, 0, 0]", "[0, 1, 0]", "0"), "fov_y is out of range; give degrees, above 0 and below 180"),
        (("[0, 0, 1]", "[0, 0, 0]", "[0, 1, 0]", "180"), "fov_y is out of range; give degrees, above 0 and below 180"),
        (
            ("[0, 0, 1]", "[0, 0, 0]", "[0, 1, 0]", "nan"),
            "a number is not finite; give finite numbers within the range of f32",
        ),
        (
            ("[0, 0, inf]", "[0, 0, 0]", "[0, 1, 0]", "40"),
            "a number is not finite; give finite numbers within the range of f32",
        ),
        (
            ("[0, 0, 1]", "[0, 1e39, 0]", "[0, 1, 0]", "40"),
            "a number is not finite; give finite numbers within the range of f32",
        ),
    ] {
        let text = format!("[camera]\neye = {eye}\ntarget = {target}\nup = {up}\nfov_y = {fov_y}");
        assert_eq!(said(&text), format!("scene.toml: [camera]: {expected}"));
    }
}

#[test]
fn numbers_are_rounded_once() {
    // Just above the middle of two f32; f64 has the middle itself, which would go down.
    let text = "[[geometry]]\nspheres = [[1.00000005960464477539062500001, 1_0.5, 16777217, 0.25]]\n\
                [camera]\neye = [1.00000005960464477539062500001, 0x10, -5]\ntarget = [0, 1_0.5, 16777217]\n\
                up = [\n  0, # the axis\n  1.00000005960464477539062500001, 0]\nfov_y = 1.00000005960464477539062500001\n";
    let loaded = scene(text).unwrap();
    let up = 1.0 + f32::EPSILON;
    let camera = loaded.camera.unwrap();
    assert_eq!((camera.eye, camera.target), (Vec3::new(up, 16.0, -5.0), Vec3::new(0.0, 10.5, 16_777_216.0)));
    assert_eq!((camera.up, camera.fov_y), (Vec3::new(0.0, up, 0.0), up));
    let [Geometry::Spheres(spheres)] = loaded.scene.geometries() else { panic!("{text}") };
    assert_eq!(spheres[0], sphere(1.0 + f32::EPSILON, 10.5, 16_777_216.0, 0.25));
}

#[test]
fn an_origin_is_subtracted_before_anything_is_rounded() {
    let wall = "v 500000 4649776.05 0\nv 500001 4649776.20 0\nv 500000 4649776.05 3\nf 1 2 3\n";
    let folder = folder(
        "origin = [500000, 4649776, 0]\n[[geometry]]\nmesh = \"wall.obj\"\n[[geometry]]\n\
                         spheres = [[500000.25, 4649777.125, 8, 0.5]]\n\
                         [camera]\neye = [500000.5, 4649770.1, 0]\ntarget = [500000, 4649776, 0]\nup = [0, 0, 1]\nfov_y = 40\n",
    );
    std::fs::write(folder.path().join("wall.obj"), wall).unwrap();
    let loaded = load(&folder.path().join("scene.toml")).unwrap();
    assert_eq!(loaded.origin, [500_000.0, 4_649_776.0, 0.0]);
    let [Geometry::Mesh(mesh), Geometry::Spheres(spheres)] = loaded.scene.geometries() else { panic!("{loaded:?}") };
    // 4649776.05 is no f64 either: what it is nearest to, less the origin, is rounded once.
    #[expect(clippy::cast_possible_truncation, reason = "what is expected")]
    let less = |y: f64| (y - 4_649_776.0) as f32;
    assert_eq!(mesh.vertices[0].to_array(), [0.0, less(4_649_776.05), 0.0]);
    assert_eq!(spheres[0], sphere(0.25, 1.125, 8.0, 0.5));
    assert_eq!(loaded.camera.unwrap().eye, Vec3::new(0.5, less(4_649_770.1), 0.0));
    assert!(loaded.rounding.largest_shift < 1e-8, "{:?}", loaded.rounding);
    let here = load_at(&folder.path().join("wall.obj"), Origin::Auto).unwrap();
    assert_eq!((here.origin, here.scene.bounds().unwrap()[1].x), ([500_000.0, 4_649_776.0, 2.0], 1.0));
    let there = load_at(&folder.path().join("scene.toml"), Origin::At([0.0; 3])).unwrap();
    assert_eq!((there.origin, there.rounding.largest_shift > 0.04), ([0.0; 3], true));
}
