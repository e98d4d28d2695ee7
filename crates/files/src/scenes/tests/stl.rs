use std::io::Cursor;

use proptest::prelude::*;

use super::{assert_same, config, mesh, message, notes, parse, unwelded, write};
use rayproof_scene::Mesh;

const FACET: &str =
    "facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

#[test]
fn several_solids_and_capitals() {
    let text = format!("solid\n{FACET}endsolid\r\n\nsolid b\n{}ENDSOLID b\n", FACET.to_uppercase());
    let mesh = parse("stl", text).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(mesh.vertices[4].to_array(), [1.0, 0.0, 0.0]);
    assert_eq!(parse("stl", "solid nothing\nendsolid nothing").unwrap(), Mesh::default());
    assert_eq!(parse("stl", write::stl_binary(&Mesh::default(), "")).unwrap(), Mesh::default());
}

#[test]
fn bad_input_is_named() {
    let out_of_place = |line: usize, text: &str, should: &str| {
        format!("f.stl: line {line}: `{text}` is out of place; `{should}` should come here")
    };
    for (text, expected) in [
        (
            format!("solid\n{FACET}facet normal 0 0 0\n"),
            "f.stl: the end of the file: the file ends inside facet 1 (counting from 0); give it up to `endsolid`".into(),
        ),
        (format!("solid\n{FACET}endsolid\n{FACET}"), out_of_place(10, "facet normal nan nan nan", "solid")),
        (format!("solid\n{}", FACET.replacen("vertex 1 0 0\n", "", 1)), out_of_place(6, "endloop", "vertex")),
        (
            format!("solid\n{}endsolid", FACET.replace("0 0\n", "0 inf\n")),
            "f.stl: line 4: the vertex (0.0, 0.0, inf) is not finite (the first of 2); give three finite numbers within the \
             range of f32"
            .into(),
        ),
        (
            format!("solid\n{}endsolid", FACET.replace("vertex 1 0 0", "vertex 1 0")),
            "f.stl: line 5: this is not three numbers; give `vertex x y z`".into(),
        ),
        (
            format!("solid\n{}endsolid", FACET.replace("vertex 1 0 0", "vertex 1 x 0")),
            "f.stl: line 5: this is not three numbers; give `vertex x y z`".into(),
        ),
        (
            "hello".into(),
            "f.stl: the header: the file ends after 5 bytes; give a whole file: a binary one has 84 bytes and 50 more a \
             facet, an ASCII one begins with `solid`"
            .into(),
        ),
    ] {
        assert_eq!(message(parse("stl", text)), expected);
    }
}

#[test]
fn bad_binaries_are_named() {
    let mesh = parse("stl", format!("solid\n{FACET}{FACET}{FACET}endsolid")).unwrap();
    let mut bytes = write::stl_binary(&mesh, "binary");
    let truncated = "f.stl: the header: it is binary, announces 3 facets, and 149 bytes follow; give a whole file: 84 bytes, \
                     and 50 more a facet";
    assert_eq!(message(parse("stl", &bytes[..bytes.len() - 1])), truncated);
    // The last vertex of the second facet, and one of the third.
    for at in [84 + 50 + 12 + 24, 84 + 100 + 12] {
        bytes[at..at + 4].copy_from_slice(&f32::NEG_INFINITY.to_le_bytes());
    }
    let expected = "f.stl: facet 1 (counting from 0): the vertex (-inf, 1.0, 0.0) is not finite (the first of 2); give three \
                    finite numbers within the range of f32";
    assert_eq!(message(parse("stl", bytes)), expected);
}

#[test]
fn every_dialect_is_the_same_mesh() {
    let plain = format!("solid a b\n{FACET}endsolid a b\n");
    let known = parse("stl", &plain).unwrap();
    for text in [
        plain.replace('\n', "\r"),
        format!("\u{feff}{plain}\0"),
        plain.replace("solid a b\nfacet", "solid a b\n# comment\ncolor 1 0 0\nfacet"),
        plain.replace('\n', " "),
        plain.replace("loop\n", "loop "),
        plain.replace("solid a b\n", "solid facet b\n"),
        plain.replace("endsolid a b\n", "endsolid\n\n"),
    ] {
        assert_eq!(parse("stl", &text).unwrap(), known, "{text:?}");
        assert_eq!(notes("stl", &text), [""; 0], "{text:?}");
    }
    let two = format!("solid a\n{FACET}endsolid a\nsolid b\n{FACET}endsolid b\n");
    assert_eq!(parse("stl", &two).unwrap(), parse("stl", two.replace('\n', " ")).unwrap());
}

#[test]
fn what_is_left_out_is_told() {
    let solid = format!("solid\n{FACET}");
    let missing = "`endsolid` is missing";
    for (text, expected) in [
        (solid.clone(), format!("f.stl: the end of the file: {missing}")),
        (format!("{solid}{solid}endsolid\n"), format!("f.stl: line 9: {missing}")),
        (
            format!("{solid}endsolid\nmade by hand\nand more\n"),
            "f.stl: line 10: text after the end of a solid is left out (the first of 2)".into(),
        ),
    ] {
        assert_eq!(notes("stl", &text), [expected], "{text:?}");
    }
    let mesh = parse("stl", format!("{solid}endsolid")).unwrap();
    for name in ["binary", "solid "] {
        let mut bytes = write::stl_binary(&mesh, name);
        bytes.extend([0; 7]);
        assert_eq!(parse("stl", &bytes).unwrap(), mesh);
        assert_eq!(notes("stl", bytes), ["f.stl: the end of the file: 7 bytes after the last facet are left out"]);
    }
}

/// The vertices of all triangles by stl_io.
fn by_stl_io(bytes: &[u8]) -> Vec<[[u32; 3]; 3]> {
    let mut bytes = Cursor::new(bytes);
    let triangles = stl_io::create_stl_reader(&mut bytes).unwrap();
    triangles.map(|t| t.unwrap().vertices.map(|v| v.0.map(f32::to_bits))).collect()
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn round_trip(mesh in mesh()) {
        let text = write::stl_ascii(&mesh);
        let binary = write::stl_binary(&mesh, "binary");
        let expected = unwelded(&mesh);
        for bytes in [text.as_bytes(), &binary] {
            let read = parse("stl", bytes).unwrap();
            assert_same(&read, &expected);
            let read: Vec<_> = read.vertices.as_chunks::<3>().0.iter().map(|t| t.map(|v| v.to_array().map(f32::to_bits))).collect();
            prop_assert_eq!(read, by_stl_io(bytes));
        }
        // The first word of a binary header means nothing.
        assert_same(&parse("stl", write::stl_binary(&mesh, "solid ")).unwrap(), &expected);
    }
}
