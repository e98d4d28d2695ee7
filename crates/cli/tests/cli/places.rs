//! What a scene's numbers become on their way to `f32`, and what is told of it.

use super::{Folder, csv_hits};

/// A strip of a floor at map coordinates, 0.15 wide, and a ray at its middle. Both of its sides are 4649776 in `f32`.
const STRIP: &str =
    "v 500000 4649776.05 0\nv 500001 4649776.05 0\nv 500001 4649776.20 0\nv 500000 4649776.20 0\nf 1 2 3 4\n";
const RAYS: &str = "ox,oy,oz,dx,dy,dz\n500000.5,4649776.1,7,0,0,-2\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("strip.obj", STRIP);
    folder.write("rays.csv", RAYS);
    folder.write("strip.toml", "origin = [500000, 4649776, 0]\n[[geometry]]\nmesh = \"strip.obj\"\n");
    folder
}

#[test]
fn what_rounding_took_is_told_with_the_remedy() {
    let folder = folder();
    let ran = folder.run("intersect strip.obj rays.csv -o hits.csv --device cpu --json").expect(
        0,
        &[
            "note    strip.obj: rounding to f32 moved a place by 2.00e-1, 2.0e-1 of the scene's size, and 2 triangles lost \
             their area; give --origin auto, or --rounding allow",
            "note    rays.csv: rounding to f32 moved a place by 1.00e-1",
            "4 values rounded to f32, by 2.0e-1 at most",
        ],
    );
    let json = ran.json();
    assert_eq!((&json["hits"], &json["scene"]["flattened_triangles"]), (&0.into(), &2.into()));
    assert_eq!((&json["scene"]["rounded_values"], &json["rounding"]["rays"]["values"]), (&4.into(), &1.into()));
    let shift = json["rounding"]["scene"]["largest_shift"].as_f64().unwrap();
    assert!((shift - 0.2).abs() < 1e-6, "{shift}");
    assert_eq!(json["notes"].as_array().unwrap().len(), 2, "{json}");

    folder.run("intersect strip.obj rays.csv -o hits.csv --device cpu --rounding error").expect(5, &["--origin auto"]);
    let quiet = folder.run("intersect strip.obj rays.csv -o hits.csv --device cpu --rounding allow").expect(0, &[]);
    assert!(!quiet.stderr.contains("note"), "{}", quiet.stderr);
    // The scene is harmless, its ray is not.
    folder.write("square.obj", super::SQUARE);
    let rounding = "line 2: oy = 4649776.1 is no f32, and rounded to 4649776.0; subtract an origin near it, or allow such rounding";
    folder.run("intersect square.obj rays.csv -o hits.npy --device cpu --rounding error").expect(5, &[rounding]);
    assert!(!folder.names().contains(&"hits.npy".to_owned()));
}

#[test]
fn an_origin_brings_back_what_rounding_took() {
    let folder = folder();
    let told = ",4649776,0 is subtracted from the scene and its rays";
    for (scene, origin) in
        [("strip.obj", "--origin auto"), ("strip.obj", "--origin 500000,4649776,0"), ("strip.toml", "")]
    {
        let line = format!("intersect {scene} rays.csv -o hits.csv --device cpu --check 1 {origin}");
        folder.run(&line).expect(0, &[told, "1 hit", "1 are exact"]);
        let hits = csv_hits(&folder.read("hits.csv"));
        assert_eq!((hits[0].0, hits[0].3, hits[0].4), (3.5, 0, 0), "{line}");
    }
    folder.run("render strip.toml -o strip.png --size 8x6 --device cpu").expect(0, &[told]);
    folder.run("rays strip.toml -o rays.npy --count 4 --kind incoherent").expect(2, &["it has an origin"]);
    folder.run("intersect strip.obj rays.csv -o hits.csv --origin 1,2").expect(2, &["give X,Y,Z"]);
}

#[test]
fn a_polygon_has_its_notch_in_every_query() {
    let folder = Folder::new();
    folder.write("rays.csv", "ox,oy,oz,dx,dy,dz\n1.5,1.5,5,0,0,-1\n0.5,0.5,5,0,0,-1\n");
    for face in ["1 2 3 4", "2 3 4 1", "3 4 1 2", "4 1 2 3", "4 3 2 1", "3 2 1 4"] {
        folder.write("dart.obj", format!("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf {face}\n"));
        let query = |query: &str| {
            folder.run(&format!("intersect dart.obj rays.csv -o hits.csv --device cpu --query {query}")).expect(0, &[]);
            String::from_utf8(folder.read("hits.csv")).unwrap()
        };
        assert_eq!((query("any").as_str(), query("count").as_str()), ("hit\n0\n1\n", "count\n0\n1\n"), "f {face}");
        query("closest");
        let hits = csv_hits(&folder.read("hits.csv"));
        assert_eq!((hits[0].0, hits[1].0), (f32::INFINITY, 5.0), "f {face}");
    }
}

#[test]
fn what_a_reader_left_out_is_a_note() {
    let folder = Folder::with_scene();
    folder.write("odd.obj", format!("{}f 1 2\ncstype bezier\nv nan 0 0\n", super::SQUARE));
    let ran = folder.run("intersect odd.obj rays.csv -o hits.csv --device cpu --json").expect(
        0,
        &[
            "note    odd.obj: line 6: a face of fewer than three corners is left out\n",
            "note    odd.obj: line 7, `cstype`: a statement that is not of a polygon mesh is left out\n",
            "note    odd.obj: line 8: a vertex that is not finite, and that no face has, is left out\n",
        ],
    );
    assert_eq!(ran.json()["notes"].as_array().unwrap().len(), 3);
}

#[test]
fn info_says_what_a_scene_holds() {
    let folder = Folder::with_scene();
    let text = |line: &str| String::from_utf8(folder.run(line).expect(0, &[]).stdout).unwrap();
    assert_eq!(
        text("info scene.toml"),
        "scene     2 triangles, 2 spheres, 2 geometries\n\
         box       [0.0, -1.0, -1.0] to [9.5, 9.5, 9.5]; the step of f32 there is 9.5e-7\n\
         geometry  0: mesh, 2 primitives, open\n          4 boundary edges, the first at triangle 0\n\
         geometry  1: spheres, 2 primitives, closed\n"
    );
    folder.write("strip.obj", STRIP);
    let json = folder.run("info strip.obj --json").expect(0, &[]).json();
    let [geometry] = &json["geometries"].as_array().unwrap()[..] else { panic!("{json}") };
    // Its sides are one line: two triangles without area, there and back.
    assert_eq!((&geometry["flat_triangles"]["count"], &geometry["closed"]), (&2.into(), &true.into()));
    assert_eq!((&json["scene"]["flattened_triangles"], json["step"].as_f64()), (&2.into(), Some(0.5)));
    assert_eq!(json["notes"].as_array().unwrap().len(), 1);
    folder.run("info strip.obj --rounding error").expect(5, &["--origin auto"]);
    folder.run("info none.obj").expect(5, &["none.obj: cannot be opened"]);
}
