use glam::Vec3;
use proptest::prelude::*;

use super::{config, mesh, message, parse, write};
use rayproof_scene::Mesh;

fn triangle() -> Mesh {
    Mesh { vertices: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z], triangles: vec![[0, 1, 2]] }
}

fn glb(mesh: &Mesh, node: &str, primitive: &str, root: &str) -> Vec<u8> {
    let (json, bin) = write::gltf(mesh, node, primitive, root);
    write::glb(&json, &bin)
}

#[test]
fn transforms_are_applied_down_the_tree() {
    let (json, bin) = write::gltf(&triangle(), "", "", "");
    // A quarter turn about z and a scale in the parent, a translation in the child, the mesh in both; a node apart.
    let nodes = r#""nodes": [{"mesh": 0, "children": [2], "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 2, 2]},
        {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]}, {"mesh": 0, "translation": [1, 0, 0]}, {"mesh": 0}]"#;
    let json = json.replace(r#""nodes": [{"mesh": 0}]"#, nodes).replace(r#""nodes": [0]"#, r#""nodes": [0, 1]"#);
    let mesh = parse("glb", write::glb(&json, &bin)).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [4, 5, 6], [8, 9, 10]]);
    let expected = [
        [0.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [-2.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
        [0.0, 2.0, 0.0],
        [0.0, 4.0, 0.0],
        [-2.0, 2.0, 0.0],
        [0.0, 2.0, 2.0],
        [10.0, 0.0, 0.0],
        [11.0, 0.0, 0.0],
        [10.0, 1.0, 0.0],
        [10.0, 0.0, 1.0],
    ];
    for (v, expected) in mesh.vertices.iter().zip(expected) {
        // The two numbers of the rotation are equal, so in f64 the quarter turn leaves a few roundings of what is 4 at most.
        assert!(v.distance(expected.into()) < 1e-14, "{v} instead of {expected:?}");
    }
}

#[test]
fn strips_and_fans_are_in_the_order_of_the_specification() {
    let vertices = vec![Vec3::ZERO; 6];
    let mesh = Mesh { vertices, triangles: vec![[0, 1, 2], [3, 4, 5]] };
    for (mode, expected) in [
        (4, vec![[0, 1, 2], [3, 4, 5]]),
        (5, vec![[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]]),
        (6, vec![[1, 2, 0], [2, 3, 0], [3, 4, 0], [4, 5, 0]]),
        (1, vec![]),
        (0, vec![]),
    ] {
        let primitive = format!(r#", "mode": {mode}"#);
        assert_eq!(parse("glb", glb(&mesh, "", &primitive, "")).unwrap().triangles, expected);
        let (json, bin) = write::gltf(&mesh, "", &primitive, "");
        let flat = json.replace(r#""indices": 1, "#, "");
        assert_ne!(flat, json);
        assert_eq!(parse("glb", write::glb(&flat, &bin)).unwrap().triangles, expected);
    }
}

#[test]
fn narrow_indices_strides_and_data_uris() {
    let (json, _) = write::gltf(&triangle(), "", "", "");
    // Positions 16 bytes apart after 4 bytes, 4 indices of one byte behind them.
    let positions: Vec<u8> = [[9.0; 4], [8.0; 4]].as_flattened().iter().flat_map(|x: &f32| x.to_le_bytes()).collect();
    let bin = [&[0; 4], &positions[..], &[1, 0, 1]].concat();
    let json = json
        .replace(r#""type": "VEC3", "count": 4"#, r#""type": "VEC3", "count": 2, "byteOffset": 4"#)
        .replace(r#""buffer": 0, "byteLength": 48"#, r#""buffer": 0, "byteLength": 36, "byteStride": 16"#)
        .replace("5125", "5121")
        .replace(r#""byteOffset": 48, "byteLength": 12"#, r#""byteOffset": 36, "byteLength": 3"#)
        .replace(r#""byteLength": 60"#, r#""byteLength": 39"#);
    let mesh = parse("glb", write::glb(&json, &bin)).unwrap();
    assert_eq!((mesh.vertices, mesh.triangles), (vec![Vec3::splat(9.0), Vec3::splat(8.0)], vec![[1, 0, 1]]));

    let (json, _) = write::gltf(&triangle(), "", "", "");
    let uri = format!(r#""uri": "data:application/octet-stream;base64,{}", "byteLength": 60"#, "AAAA".repeat(20));
    let mesh = parse("gltf", json.replace(r#""byteLength": 60"#, &uri)).unwrap();
    assert_eq!((mesh.vertices, mesh.triangles), (vec![Vec3::ZERO; 4], vec![[0; 3]]));
}

#[test]
fn buffers_are_files_beside_it_and_images_are_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let image = r#", "images": [{"uri": "missing.png"}], "extensionsRequired": ["KHR_materials_unlit"]"#;
    let (json, bin) = write::gltf(&triangle(), "", "", image);
    let path = folder.path().join("Scene.GLTF");
    std::fs::write(&path, json.replace(r#""byteLength": 60"#, r#""uri": "a%20b.bin", "byteLength": 60"#)).unwrap();
    let missing = crate::load(&path).unwrap_err();
    assert!(matches!(&missing, crate::Error::Open { path, .. } if *path == folder.path().join("a b.bin")), "{missing}");
    std::fs::write(folder.path().join("a b.bin"), &bin).unwrap();
    assert_eq!(crate::load(&path).unwrap().scene.geometries(), [rayproof_scene::Geometry::Mesh(triangle())]);
    std::fs::write(folder.path().join("a b.bin"), &bin[..59]).unwrap();
    let said = message(crate::load(&path));
    let expected = ": buffer 0: 60 bytes are announced and 59 are there; give the whole buffer";
    assert!(said.ends_with(expected), "{said}");
}

#[test]
fn bad_input_is_named() {
    let nan = Mesh { vertices: vec![Vec3::ZERO, Vec3::NAN, Vec3::INFINITY], triangles: vec![[0, 1, 2]] };
    let range = Mesh { triangles: vec![[0, 1, 4], [5, 1, 2]], ..triangle() };
    let big = Mesh { vertices: vec![Vec3::splat(1e38); 3], triangles: vec![[0, 1, 2]] };
    for (mesh, node, primitive, root, expected) in [
        (
            &nan,
            "",
            "",
            "",
            "node 0, primitive 0, vertex 1 in world space (counting from 0): the vertex (NaN, NaN, NaN) is not finite (the \
             first of 2); give three finite numbers within the range of f32",
        ),
        (
            &big,
            r#", "scale": [1, 1, 10]"#,
            "",
            "",
            "node 0, primitive 0, vertex 0 in world space (counting from 0): the vertex (1e38, 1e38, inf) is not finite (the \
             first of 3); give three finite numbers within the range of f32",
        ),
        (
            &range,
            "",
            "",
            "",
            "node 0, primitive 0, index 2 (counting from 0): vertex 4 is out of range (the first of 2); it has 4 vertices: \
             give indices from 0 and below 4",
        ),
        (&triangle(), r#", "children": [0]"#, "", "", "node 0: it is reached twice; give each node one parent at most"),
        (&triangle(), "", r#", "mode": 9"#, "", "node 0, primitive 0: its mode is 9; give a mode from 0 to 6"),
        (
            &triangle(),
            "",
            "",
            r#", "extensionsRequired": ["KHR_draco_mesh_compression"]"#,
            "extensionsRequired: KHR_draco_mesh_compression is not read; write it without Draco compression",
        ),
    ] {
        assert_eq!(message(parse("glb", glb(mesh, node, primitive, root))), format!("f.glb: {expected}"));
    }
}

#[test]
fn an_index_out_of_range_does_not_overflow() {
    // The second primitive's indices are counted from the vertices of the first.
    let worst = Mesh { triangles: vec![[u32::MAX, 0, 1]], ..triangle() };
    let (json, bin) = write::gltf(&worst, "", "", "");
    let json = json.replace(r#""primitives": ["#, r#""primitives": [{"attributes": {"POSITION": 0}, "mode": 6}, "#);
    let expected = "f.glb: node 0, primitive 1, index 0 (counting from 0): vertex 4294967295 is out of range; it has 4 \
                    vertices: give indices from 0 and below 4";
    assert_eq!(message(parse("glb", write::glb(&json, &bin))), expected);
}

#[test]
fn what_does_not_fit_is_named() {
    let view = "accessor 0: it reaches beyond its buffer view; give an offset, stride and count whose values lie within the \
                buffer view, and a view within the buffer";
    let count = |n: &str| (r#""VEC3", "count": 4"#, format!(r#""VEC3", "count": {n}"#));
    for ((from, to), expected) in [
        (count("5"), view),
        (count("1000000000000000000"), view),
        ((r#""buffer": 0, "byteLength": 48"#, r#""buffer": 0, "byteLength": 48, "byteOffset": 18446744073709551615"#.into()), view),
        ((r#""type": "VEC3""#, r#""type": "VEC4""#.into()), "accessor 0: it is VEC4 of the component type 5126; give VEC3 of a type from 5120 to 5126"),
        (("5125", "5126".into()), "accessor 1: it is not a SCALAR of an unsigned type; give indices as one"),
        ((r#""count": 3"#, r#""count": 2"#.into()), "node 0, primitive 0: 2 vertices are not whole triangles; give three a triangle"),
        (("\"POSITION\": 0", "\"POSITION\": 7".into()), "accessor: 7 is out of range; there are 2"),
        (
            ("\"scenes\": [{\"nodes\": [0]}]", "\"scenes\": []".into()),
            "scene: scene 0 is out of range; give the number of a scene",
        ),
        (
            (r#""byteLength": 60"#, r#""uri": "%ff", "byteLength": 60"#.into()),
            "buffer 0: `%ff`: invalid utf-8 sequence of 1 bytes from index 0; percent-encode the path as UTF-8",
        ),
        (
            (r#""byteLength": 60"#, r#""uri": "http://a/b", "byteLength": 60"#.into()),
            "buffer 0: unsupported URI scheme; give a relative path, a data URI or the binary chunk of a GLB",
        ),
        (
            (r#""VEC3", "count": 4"#, r#""VEC3", "count": 2, "sparse": {"count": 3, "indices": {"bufferView": 1, "componentType": 5125}, "values": {"bufferView": 0}}"#.into()),
            "accessor 0: sparse index 2 is out of range; give one below the count",
        ),
        (("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 0".into()), view),
        (
            (r#""byteLength": 60"#, r#""uri": "/etc/passwd", "byteLength": 60"#.into()),
            "buffer 0: its path is absolute; give a path relative to this file",
        ),
        (
            (r#""byteLength": 60"#, r#""uri": "src", "byteLength": 60"#.into()),
            "buffer 0: src is no regular file; give a file",
        ),
        (("\"2.0\"", "\"1.0\"".into()), "asset.version: it is glTF 1.0; convert it to glTF 2.0"),
    ] {
        let (json, bin) = write::gltf(&triangle(), "", "", "");
        let changed = json.replacen(from, &to, 1);
        assert_ne!(changed, json, "{from}");
        assert_eq!(message(parse("glb", write::glb(&changed, &bin))), format!("f.glb: {expected}"));
    }
    let mut short = glb(&triangle(), "", "", "");
    short[8..12].copy_from_slice(&4_u32.to_le_bytes());
    let expected = "f.glb: the file: the GLB header is broken off or announces less than itself; give a whole glTF 2.0 or GLB file";
    assert_eq!(message(parse("glb", short)), expected);
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn round_trip(mesh in mesh()) {
        let read = parse("glb", glb(&mesh, "", "", "")).unwrap();
        // The world transform adds +0: the sign of a zero is not kept.
        let bits = |mesh: &Mesh| mesh.vertices.iter().map(|v| (*v + 0.0).to_array().map(f32::to_bits)).collect::<Vec<_>>();
        prop_assert_eq!(bits(&read), bits(&mesh));
        prop_assert_eq!(read.triangles, mesh.triangles);
    }
}
