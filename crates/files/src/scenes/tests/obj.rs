use proptest::prelude::*;

use super::{assert_same, config, mesh, message, notes, parse, told, write};

#[test]
fn polygons_fan_out_in_order() {
    let text = "v 0 0 0\nv 1 0 0 1 0.5 0.5\nv 1 1 0\r\nv 0 1 0 1\n\n# c\u{e9}\nvn 0 0 1\ng a b\nusemtl m\ns off\n\
                f 1 2 3 4\nf 1/1 2/1/1 3//1\nf -4 -3 -1\n  f\t4 4 4\nl 1 2\n";
    // A name in Latin-1 is no concern of ours.
    let latin1: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    for bytes in [text.as_bytes(), &latin1] {
        let mesh = parse("obj", bytes).unwrap();
        assert_eq!(mesh.vertices.len(), 4);
        assert_eq!(mesh.vertices[2].to_array(), [1.0, 1.0, 0.0]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 1, 3], [3, 3, 3]]);
    }
}

#[test]
fn a_face_may_come_before_its_vertices() {
    let mesh = parse("obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
}

#[test]
fn nothing_is_an_empty_mesh() {
    assert_eq!(parse("obj", "").unwrap(), rayproof_scene::Mesh::default());
    assert_eq!(parse("obj", "v 1 2 3\n").unwrap().triangles.len(), 0);
}

#[test]
fn decimals_are_rounded_once() {
    // Just above the middle of two f32: rounded to f64 first, it would be a tie and go to the even one below.
    let mesh = parse("obj", "v 1.00000005960464477540 0 0").unwrap();
    assert_eq!(mesh.vertices[0].x, 1.0 + f32::EPSILON);
}

#[test]
fn bad_input_is_named() {
    let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (text, expected) in [
        (
            "f 1 2 4\nf 1 2 3\nf 0 1 2\nf 1 2 -4\n",
            "f.obj: line 4: vertex 4 is out of range (the first of 3); the file has 3 vertices: give 1 to 3, or from \
             -1 back to the first",
        ),
        (
            "v nan 0 0\nv 0 -inf 0\nf 4 5 1\n",
            "f.obj: line 4: the vertex (NaN, 0.0, 0.0) is not finite (the first of 2); give three \
             finite numbers within the range of f32",
        ),
        (
            "v 1e39 0 0\nf 1 2 -1\n",
            "f.obj: line 4: the vertex (inf, 0.0, 0.0) is not finite; give three finite numbers within the \
             range of f32",
        ),
        ("v 1 two 3\n", "f.obj: line 4: `two` is not a number; give a vertex 3, 4, 6 or 7 numbers and nothing else"),
        ("v 1 2\n", "f.obj: line 4: it is 2 numbers; give a vertex 3, 4, 6 or 7 numbers and nothing else"),
        ("v 1 2 3 4 5\n", "f.obj: line 4: it is 5 numbers; give a vertex 3, 4, 6 or 7 numbers and nothing else"),
        (
            "v 1 2 3 v 4 5 6\n",
            "f.obj: line 4: `v` is not a number; give a vertex 3, 4, 6 or 7 numbers and nothing else",
        ),
        ("f 1 2 c\n", "f.obj: line 4: `c` is not the number of a vertex; give a face as v, v/vt, v//vn or v/vt/vn"),
        (
            "f 1 2 99999999999999999999\n",
            "f.obj: line 4: `99999999999999999999` is not the number of a vertex; give a \
             face as v, v/vt, v//vn or v/vt/vn",
        ),
        (
            "surf 0 1 0 1 1 2\n",
            "f.obj: line 4: `surf` may hold a surface, and is not read; give every surface as polygons, in v and f statements",
        ),
    ] {
        assert_eq!(message(parse("obj", format!("{file}{text}"))), expected);
    }
}

#[test]
fn every_dialect_is_the_same_mesh() {
    let known = parse("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    for text in [
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
        "v 0 0 0\r\nv 1 0 0\rv 0 1 0\nf 1 2 3",
        "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\u{1a}",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\0\0\0",
        "v 0 0 0 # the origin\nv 1 0 0#\nv 0 1 0\nf 1 2 3 # all\n# v 5 5 5 \\\n",
        "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n 2 \\\n3 \\",
        "mtllib c:\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n",
        "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 255 0 0\nf 1/1 2/2/2 3//3\n",
    ] {
        assert_eq!(parse("obj", text).unwrap(), known, "{text:?}");
        assert_eq!(notes("obj", text), [""; 0], "{text:?}");
    }
}

#[test]
fn what_is_left_out_is_told() {
    let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (text, expected) in [
        ("f 1 2\nf\nf 1\n", "f.obj: line 5: a face of fewer than three corners is left out (the first of 3)"),
        (
            "cstype bezier\ncurv 0 1 1 2 \\\n3\nend\n",
            "f.obj: line 5, `cstype`: a statement that is not of a polygon mesh is left out (the first of 3)",
        ),
        (
            "v nan 0 0\nv 1e39 0 0\n",
            "f.obj: line 5: a vertex that is not finite, and that no face has, is left out (the first of 2)",
        ),
        ("v 1 1 0\nf 1 4 2 3\n", "f.obj: line 6: a polygon that crosses itself is fanned from its first corner"),
    ] {
        assert_eq!(notes("obj", format!("{file}{text}")), [expected]);
        assert_eq!(parse("obj", format!("{file}{text}")).unwrap().triangles[0], [0, 1, 2]);
    }
    let nothing = "f.obj: the file: it holds neither vertices nor faces; give an OBJ file of v and f statements";
    assert_eq!(message(parse("obj", "<html>\n</html>")), nothing);
    assert_eq!(
        message(parse("obj", "f 1 2 3")),
        "f.obj: line 1: vertex 1 is out of range (the first of 3); the file has no vertices: give them in v statements"
    );
}

#[test]
fn a_polygon_keeps_its_notch() {
    let mesh = parse("obj", "f 2 3 4 1\nf 1 2 3\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n").unwrap();
    assert_eq!(mesh.triangles, [[2, 3, 0], [1, 2, 0], [0, 1, 2]]);
}

#[test]
fn what_rounding_did_is_told() {
    // A wall of 0.15 at map coordinates: both of its sides are 4649776 in f32.
    let wall = "v 500000 4649776.05 0\nv 500001 4649776.20 0\nv 500000 4649776.05 3\nf 1 2 3\nf 1 1 2\n";
    let rounding = told("obj", wall).unwrap().1.rounding;
    assert_eq!((rounding.values, rounding.flattened_triangles), (3, 0));
    assert!((rounding.largest_shift - 0.2).abs() < 1e-6, "{rounding:?}");
    let flat = wall.replace("500001", "500000.01");
    let rounding = told("obj", flat).unwrap().1.rounding;
    assert_eq!((rounding.values, rounding.flattened_triangles), (4, 1));
    assert_eq!(told("obj", "v 0.5 1e10 0x\n".replace("0x", "-3")).unwrap().1.rounding, crate::Rounding::default());
}

/// The corners of all triangles by tobj.
fn by_tobj(text: &str) -> Vec<[u32; 3]> {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default())).unwrap();
    let corners = models.iter().flat_map(|m| m.mesh.indices.iter().map(|&i| &m.mesh.positions[3 * i as usize..][..3]));
    corners.map(|p| [p[0], p[1], p[2]].map(f32::to_bits)).collect()
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn round_trip(mesh in mesh()) {
        let text = write::obj(&mesh);
        assert_same(&parse("obj", &text).unwrap(), &mesh);
    }

    #[test]
    fn convex_polygons_are_what_tobj_reads(mesh in mesh(), sizes in prop::collection::vec(3_usize..7, 0..6)) {
        let mut text = write::obj(&mesh);
        for (x, y) in [(0, 0), (4, 0), (6, 2), (6, 4), (4, 6), (1, 6), (0, 4)] {
            text += &format!("v {x} {y} {}\n", x + y);
        }
        for (i, size) in sizes.into_iter().enumerate() {
            let corners: Vec<_> = (0..size).map(|k| format!("{}", mesh.vertices.len() + 1 + (i + k) % 7)).collect();
            text += &format!("f {}\n", corners.join(" "));
        }
        let read = super::unwelded(&parse("obj", &text).unwrap());
        let read: Vec<_> = read.vertices.iter().map(|v| v.to_array().map(f32::to_bits)).collect();
        prop_assert_eq!(read, by_tobj(&text));
    }
}
