use proptest::prelude::*;

use super::{assert_same, config, mesh, message, notes, parse, write};

const FORMATS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

/// An ASCII file of three vertices.
fn ascii(vertices: &str, faces: usize, rows: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list uchar int vertex_index\nend_header\n{vertices}\n{rows}"
    )
}

const CORNERS: &str = "0 0 0\n1 0 0\n0 1 0";

#[test]
fn faces_are_triangles_in_order() {
    let mesh = parse("ply", ascii("0. .5 -0\n1e0 +1 2\n\n 3\t4 5 ", 3, "3 0 1 2\n5 0 1 2 1 0\n3 2 2 2")).unwrap();
    assert_eq!(mesh.vertices[0].to_array(), [0.0, 0.5, 0.0]);
    assert_eq!(mesh.vertices[2].to_array(), [3.0, 4.0, 5.0]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [1, 2, 1], [1, 1, 0], [0, 1, 0], [2, 2, 2]]);
}

#[test]
fn faces_may_come_first_and_need_not_come_at_all() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n\
                property double x\nproperty double y\nproperty double z\nend_header\n3 2 1 0\n0 0 0\n1 0 0\n0.1 1 0\n";
    let mesh = parse("ply", text).unwrap();
    assert_eq!((mesh.triangles[0], mesh.vertices[2].x), ([2, 1, 0], 0.1));
    let cloud =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n1 2 3";
    assert_eq!(parse("ply", cloud).unwrap().vertices[0].to_array(), [1.0, 2.0, 3.0]);
    assert_eq!(parse("ply", "ply\nformat ascii 1.0\nend_header\n").unwrap(), rayproof_scene::Mesh::default());
}

#[test]
fn bad_faces_and_vertices_are_named() {
    for (vertices, faces, rows, expected) in [
        (
            CORNERS,
            3,
            "3 0 1 3\n3 0 1 2\n3 0 -1 2",
            "f.ply: face 0 (counting from 0): vertex 3 is out of range (the first of 2); the header declares 3 vertices: \
             give indices from 0 and below 3",
        ),
        (
            "0 0 0\n0 nan 0\n1e39 0 0",
            1,
            "3 0 1 2",
            "f.ply: vertex 1 (counting from 0): the vertex (0.0, NaN, 0.0) is not finite (the first of 2); give three finite \
             numbers within the range of f32",
        ),
        (
            "0 0 0\n0 one 0\n0 0",
            0,
            "",
            "f.ply: vertex 1 (counting from 0): `one` is not a number of the type that the header declares; give the \
             values that the header declares, and a list's length before it",
        ),
        (
            "0 0 0\n0 0\n0 0",
            0,
            "",
            "f.ply: vertex 2 (counting from 0): the file ends here, or a list has a negative length; the header declares \
             3; give the whole file",
        ),
        (
            CORNERS,
            1,
            "3 0 1 2 0",
            "f.ply: the last line: `0` is a value too many; give one line an element, with the values that the header \
             declares",
        ),
        (
            "0 0 0 9\n1 0 0\n0 1 0",
            1,
            "3 0 1 2",
            "f.ply: vertex 1 (counting from 0): it does not stand on one line, and `3 0 1 2` follows the last element; give \
             one line an element, with the values that the header declares",
        ),
        (
            CORNERS,
            2,
            "3 0 1 2\n",
            "f.ply: face 1 (counting from 0): the file ends here, or a list has a negative length; the header declares 2; \
             give the whole file",
        ),
    ] {
        assert_eq!(message(parse("ply", ascii(vertices, faces, rows))), expected);
    }
}

#[test]
fn every_dialect_is_the_same_mesh() {
    let known = parse("ply", ascii(CORNERS, 1, "3 0 1 2")).unwrap();
    let plain = ascii(CORNERS, 1, "3 0 1 2\n");
    let spaces =
        plain.replace("property float x", "  property\tfloat   x ").replace("end_header\n", "\n\nend_header\n");
    let cr = plain.replace('\n', "\r");
    let latin1: Vec<u8> = plain
        .replace("element face", "comment \u{e9}t\u{e9}\nobj_info 3\nelement face")
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    for bytes in [
        plain.clone().into_bytes(),
        cr.into_bytes(),
        plain.replace('\n', "\r\n").into_bytes(),
        spaces.into_bytes(),
        format!("\u{feff}{plain}").into_bytes(),
        latin1,
        plain.replace("list uchar int", "list uint64 int64").into_bytes(),
        plain.replace("list uchar int", "list uint uint").into_bytes(),
    ] {
        assert_eq!(parse("ply", &bytes).unwrap(), known, "{:?}", String::from_utf8_lossy(&bytes));
        assert_eq!(notes("ply", &bytes), [""; 0], "{:?}", String::from_utf8_lossy(&bytes));
    }
    // A header that ends with CR, and values that begin with what could be the LF to it.
    let header = "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty float x\rproperty float y\rproperty float z\r\
                  element face 1\rproperty list uchar ushort vertex_indices\rend_header\r";
    let mut bytes = header.as_bytes().to_vec();
    let first = f32::from_le_bytes([b'\n', 0, 0, 0x3f]);
    for x in [first, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(x.to_le_bytes());
    }
    bytes.extend([3, 0, 0, 1, 0, 2, 0]);
    let mesh = parse("ply", &bytes).unwrap();
    assert_eq!((mesh.vertices[0].x, &mesh.triangles[..]), (first, &[[0, 1, 2]][..]));
}

#[test]
fn other_elements_and_properties_are_passed_over() {
    let text = "ply\nformat ascii 1.0\nelement camera 1\nproperty float x\nproperty float x\nproperty list uchar float v\n\
                element vertex 3\nproperty float x\nproperty float y\nproperty list uchar int a\nproperty float z\n\
                property uchar red\nelement face 1\nproperty int id\nproperty list uchar int vertex_index\n\
                property list uchar float texcoord\nelement edge 1\nproperty int v1\nend_header\n\
                1 2 2 3 4\n0 0 1 7 0 255\n1 0 0 0 255\n0 1 0 0 255\n5 3 0 1 2 2 .5 .5\n0\n";
    for bytes in [text.to_owned(), text.replace("float z", "double z")] {
        let mesh = parse("ply", bytes).unwrap();
        assert_eq!(mesh.vertices[1].to_array(), [1.0, 0.0, 0.0]);
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
    }
}

#[test]
fn strips_are_triangles() {
    let strip = |rows: &str| {
        ascii("0 0 0\n1 0 0\n0 1 0", 1, rows)
            .replace("element face", "element tristrips")
            .replace("vertex_index", "vertex_indices")
    };
    let mesh = parse("ply", strip("10 0 1 2 0 -1 2 1 -1 -1 0")).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 0]]);
    let expected = "f.ply: tristrips 0 (counting from 0): vertex -2 is out of range; the header declares 3 vertices: give \
                    indices from 0 and below 3";
    assert_eq!(message(parse("ply", strip("3 0 -2 1"))), expected);
}

#[test]
fn what_is_left_out_is_told() {
    for (vertices, faces, rows, expected) in [
        (
            CORNERS,
            2,
            "2 0 1\n0",
            "f.ply: face 0 (counting from 0): a face of fewer than three corners is left out (the first of 2)",
        ),
        (CORNERS, 0, "3 0 1 2", "f.ply: the end of the file: 7 bytes after the last element are left out"),
        (
            "0 0\n0 1 0\n0 0 1 0",
            1,
            "3 0 1 2",
            "f.ply: vertex 0 (counting from 0): values are taken one after the other, whatever line they stand on",
        ),
        (
            "0 0 0\n0 nan 0\n1e39 0 0",
            0,
            "",
            "f.ply: vertex 1 (counting from 0): a vertex that is not finite, and that no face has, is left out (the first of 2)",
        ),
    ] {
        assert_eq!(notes("ply", ascii(vertices, faces, rows)), [expected]);
    }
    let mut bytes = write::ply(&parse("ply", ascii(CORNERS, 1, "3 0 1 2")).unwrap(), "binary_big_endian", "double");
    bytes.extend([0; 9]);
    assert_eq!(notes("ply", bytes), ["f.ply: the end of the file: 9 bytes after the last element are left out"]);
}

#[test]
fn bad_headers_are_named() {
    let header = "give a PLY header: ply, format, element, property, end_header";
    let xyz = "property float x\nproperty float y\nproperty float z";
    for (text, expected) in [
        (String::new(), format!("f.ply: line 1: it does not begin with `ply`; {header}")),
        ("plyformat".into(), format!("f.ply: line 1: it does not begin with `ply`; {header}")),
        ("ply\nformat ascii 1.0\nelemnt".into(), format!("f.ply: line 3: this is `elemnt`; {header}")),
        ("ply\nformat ascii 1.0\n".into(), format!("f.ply: the header: the file ends before `end_header`; {header}")),
        ("ply\nend_header\n".into(), format!("f.ply: the header: it has no `format`; {header}")),
        (
            "ply\nformat text 1.0\n".into(),
            "f.ply: line 2: this is `format text 1.0`; give `format` with ascii, binary_little_endian or \
             binary_big_endian, and 1.0"
                .into(),
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex -1\n".into(),
            "f.ply: line 3: this is `element vertex -1`; give `element`, a name and how many there are".into(),
        ),
        (
            "ply\nformat ascii 1.0\nproperty float x\n".into(),
            "f.ply: line 3: this is `property float x`; after an element give `property TYPE NAME` or `property list TYPE \
             TYPE NAME`"
                .into(),
        ),
        (
            format!("ply\nformat ascii 1.0\nelement vertex 1\n{xyz}\nproperty float x\nend_header\n1 2 3 4"),
            "f.ply: element `vertex`: the property x is declared twice; give it once".into(),
        ),
        (
            format!("ply\nformat ascii 1.0\nelement vertex 1\n{xyz}\nelement vertex 1\n{xyz}\nend_header\n1 2 3 4"),
            "f.ply: the header: the element vertex is declared twice; give it once".into(),
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 2".into(),
            "f.ply: element `vertex`: x, y or z is missing; declare them as `property float`".into(),
        ),
        (
            format!(
                "ply\nformat ascii 1.0\nelement vertex 0\n{xyz}\nelement face 0\n\
                 property list uchar float vertex_indices\nend_header\n"
            ),
            "f.ply: element `face`: vertex_indices is missing or not a list of integers; declare `property list uchar int \
             vertex_indices`"
                .into(),
        ),
    ] {
        assert_eq!(message(parse("ply", text)), expected);
    }
}

#[test]
fn a_header_may_claim_anything() {
    for format in FORMATS {
        let text = format!(
            "ply\nformat {format} 1.0\nelement nothing 1000000000000000000\nelement vertex 1000000000000000000\n\
             property float x\nproperty float y\nproperty float z\nelement face 1000000000000000000\n\
             property list int int vertex_indices\nend_header\n"
        );
        let expected = "f.ply: vertex 0 (counting from 0): the file ends here, or a list has a negative length; the header \
                        declares 1000000000000000000; give the whole file";
        assert_eq!(message(parse("ply", text)), expected);
    }
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn round_trip(mesh in mesh(), format in prop::sample::select(&FORMATS[..]), real in prop::sample::select(&["float", "double"][..])) {
        assert_same(&parse("ply", write::ply(&mesh, format, real)).unwrap(), &mesh);
    }
}
