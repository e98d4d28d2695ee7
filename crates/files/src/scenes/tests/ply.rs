use proptest::prelude::*;

use super::{assert_same, config, mesh, message, parse, write};

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
fn polygons_fan_out_in_order() {
    let mesh = parse("ply", ascii("0. .5 -0\n1e0 +1 2\n\n 3\t4 5 ", 3, "3 0 1 2\n5 0 1 2 1 0\n3 2 2 2")).unwrap();
    assert_eq!(mesh.vertices[0].to_array(), [0.0, 0.5, 0.0]);
    assert_eq!(mesh.vertices[2].to_array(), [3.0, 4.0, 5.0]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2], [0, 2, 1], [0, 1, 0], [2, 2, 2]]);
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
            0,
            "",
            "f.ply: vertex 1 (counting from 0): the vertex (0.0, NaN, 0.0) is not finite (the first of 2); give three finite \
             numbers within the range of f32",
        ),
        (
            CORNERS,
            1,
            "2 0 1",
            "f.ply: face 0 (counting from 0): it has only 2 vertices; give a face three vertices or more",
        ),
        (
            "0 0 0\n0 one 0\n0 0",
            0,
            "",
            "f.ply: vertex 1 (counting from 0): `0 one 0` is not the values that the header declares (the first of 2); give \
             one line an element, with its values as numbers and a list's length before it",
        ),
        (
            CORNERS,
            1,
            "3 0 1 2 0",
            "f.ply: face 0 (counting from 0): `3 0 1 2 0` is not the values that the header declares; give one line an \
             element, with its values as numbers and a list's length before it",
        ),
        (
            CORNERS,
            2,
            "3 0 1 2\n",
            "f.ply: face 1 (counting from 0): the file ends here, or a list has a negative length; the header declares 2; \
             give the whole file",
        ),
        (
            CORNERS,
            0,
            "3 0 1 2",
            "f.ply: the end of the file: 7 bytes follow that the header does not declare; declare as many elements as there \
             are",
        ),
    ] {
        assert_eq!(message(parse("ply", ascii(vertices, faces, rows))), expected);
    }
}

#[test]
fn bad_headers_are_named() {
    let header = "give a PLY header: ply, format, element, property, end_header";
    let xyz = "property float x\nproperty float y\nproperty float z";
    for (text, expected) in [
        ("".into(), format!("f.ply: the header: Unexpected end of file while reading magic number.; {header}")),
        ("plyformat".into(), format!("f.ply: line 1: Expected magic number 'ply'.; {header}")),
        ("ply\nformat ascii 1.0\nelemnt".into(), format!("f.ply: line 3: Couldn't parse line.; {header}")),
        (
            format!("ply\nformat ascii 1.0\nelement vertex 1\n{xyz}\nproperty float x\nend_header\n1 2 3 4"),
            "f.ply: the header: a name is declared twice; give each element, and each property of an element, a name of its \
             own"
            .into(),
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 2".into(),
            "f.ply: element `vertex`: x, y or z is missing; declare them as `property float`".into(),
        ),
        (
            format!("ply\nformat ascii 1.0\nelement vertex 0\n{xyz}\nelement face 0\nproperty list uchar float vertex_indices\nend_header\n"),
            "f.ply: element `face`: vertex_indices is missing or not a list of integers; declare `property list uchar int \
             vertex_indices`"
            .into(),
        ),
        (
            "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n".into(),
            "f.ply: element `tristrips`: triangle strips are not read; give the triangles as element `face`".into(),
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
