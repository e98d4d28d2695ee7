//! What moves the vertices of a glTF file, against matrices written out here.

use super::{message, notes, parse, write};
use crate::Error;
use rayproof_scene::Mesh;

/// A file in the making: each piece of data its own buffer view and accessor.
#[derive(Default)]
struct Made {
    bin: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl Made {
    /// Adds an accessor of these bytes; returns its number.
    fn add(&mut self, bytes: &[u8], component: u32, shape: &str, count: usize, more: &str) -> usize {
        let view = self.view(bytes);
        self.accessors.push(format!(
            r#"{{"bufferView": {view}, "componentType": {component}, "type": "{shape}", "count": {count}{more}}}"#
        ));
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let at = self.bin.len();
        self.views.push(format!(r#"{{"buffer": 0, "byteOffset": {at}, "byteLength": {}}}"#, bytes.len()));
        self.bin.extend(bytes);
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        self.views.len() - 1
    }

    fn floats(&mut self, values: &[f32], shape: &str, count: usize) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.add(&bytes, 5126, shape, count, "")
    }

    fn glb(&self, rest: &str) -> Vec<u8> {
        let json = format!(
            r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {}}}], "bufferViews": [{}], "accessors": [{}], {rest}}}"#,
            self.bin.len(),
            self.views.join(","),
            self.accessors.join(",")
        );
        write::glb(&json, &self.bin)
    }

    fn mesh(&self, rest: &str) -> Result<Mesh, Error> {
        parse("glb", self.glb(rest))
    }
}

const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

fn vertices(mesh: &Mesh) -> Vec<[f32; 3]> {
    mesh.vertices.iter().map(|v| v.to_array()).collect()
}

#[test]
fn a_skin_alone_says_where_its_mesh_is() {
    let mut made = Made::default();
    let positions = made.floats(&TRIANGLE, "VEC3", 3);
    let joints = made.add(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], 5121, "VEC4", 3, "");
    // The third vertex is half with each joint.
    let weights = made.add(&[255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0], 5121, "VEC4", 3, r#", "normalized": true"#);
    // The first joint was bound at (0, 0, -1), the second at (-1, 0, 0): column by column.
    let inverse = [
        [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
    ];
    let inverse = made.floats(inverse.as_flattened(), "MAT4", 2);
    let rest = format!(
        r#""scene": 0, "scenes": [{{"nodes": [0, 1]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": {positions}, "JOINTS_0": {joints}, "WEIGHTS_0": {weights}}}}}]}}],
        "skins": [{{"joints": [1, 2], "inverseBindMatrices": {inverse}}}],
        "nodes": [{{"mesh": 0, "skin": 0, "translation": [100, 100, 100]}},
            {{"translation": [5, 0, 0], "children": [2]}}, {{"translation": [0, 10, 0], "scale": [2, 2, 2]}}]"#
    );
    // Joint 1: translate (5, 0, 0) after (0, 0, 1). Joint 2: translate (5, 10, 0) after scale 2 after (1, 0, 0).
    let first = |[x, y, z]: [f32; 3]| [x + 5.0, y, z + 1.0];
    let second = |[x, y, z]: [f32; 3]| [2.0 * (x + 1.0) + 5.0, 2.0 * y + 10.0, 2.0 * z];
    let third = [0, 1, 2].map(|i| 0.2 * first([0.0, 1.0, 0.0])[i] + 0.8 * second([0.0, 1.0, 0.0])[i]);
    let mesh = made.mesh(&rest).unwrap();
    assert_eq!(vertices(&mesh)[..2], [first([0.0; 3]), second([1.0, 0.0, 0.0])]);
    assert!(mesh.vertices[2].distance(third.into()) < 1e-5, "{mesh:?} {third:?}");
    let lost = rest.replace(r#""nodes": [0, 1]"#, r#""nodes": [0]"#);
    assert_eq!(
        message(made.mesh(&lost)),
        "f.glb: skin 0: its joint, node 1, is not in the scene; put it into the scene"
    );
    let none = rest.replace("JOINTS_0", "JOINTS_9");
    assert_eq!(
        message(made.mesh(&none)),
        "f.glb: node 0, primitive 0: its node has a skin, and it no JOINTS_0 and WEIGHTS_0; give both"
    );
}

#[test]
fn morph_targets_have_their_default_weights() {
    let mut made = Made::default();
    let positions = made.floats(&TRIANGLE, "VEC3", 3);
    let up = made.floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0], "VEC3", 3);
    // Sparse, with nothing below: only vertex 2 moves, by (8, 0, 0).
    let index = made.view(&[2, 0]);
    let value = made.view(&[8.0_f32, 0.0, 0.0].map(f32::to_le_bytes).concat());
    made.accessors.push(format!(
        r#"{{"componentType": 5126, "type": "VEC3", "count": 3, "sparse": {{"count": 1,
        "indices": {{"bufferView": {index}, "componentType": 5123}}, "values": {{"bufferView": {value}}}}}}}"#
    ));
    let aside = made.accessors.len() - 1;
    let rest = |mesh: &str, node: &str| {
        format!(
            r#""scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0{node}}}],
            "meshes": [{{{mesh}"primitives": [{{"attributes": {{"POSITION": {positions}}},
            "targets": [{{"POSITION": {up}}}, {{"NORMAL": 9}}, {{"POSITION": {aside}}}]}}]}}]"#
        )
    };
    let z = |rest: &str| vertices(&made.mesh(rest).unwrap());
    assert_eq!(z(&rest("", "")), [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let by_mesh = rest(r#""weights": [0.5, 1, 0.25], "#, "");
    assert_eq!(z(&by_mesh), [[0.0, 0.0, 0.5], [1.0, 0.0, 1.0], [2.0, 1.0, 2.0]]);
    let by_node = rest(r#""weights": [0.5, 1, 0.25], "#, r#", "weights": [0, 0, -1]"#);
    assert_eq!(z(&by_node), [[0.0; 3], [1.0, 0.0, 0.0], [-8.0, 1.0, 0.0]]);
}

#[test]
fn copies_and_nodes_that_are_not_shown() {
    let mut made = Made::default();
    let positions = made.floats(&TRIANGLE, "VEC3", 3);
    let moves = made.floats(&[10.0, 0.0, 0.0, 0.0, 20.0, 0.0], "VEC3", 2);
    // Half a turn about z for the second, in bytes that stand for -1 to 1.
    let turns = made.add(&[0, 0, 0, 127, 0, 0, 127, 0], 5120, "VEC4", 2, r#", "normalized": true"#);
    let scales = made.floats(&[1.0, 1.0, 1.0, 3.0, 3.0, 3.0], "VEC3", 2);
    let rest = format!(
        r#""scene": 0, "scenes": [{{"nodes": [0, 1]}}], "extensionsRequired": ["EXT_mesh_gpu_instancing", "KHR_node_visibility"],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": {positions}, "_ID": 77}}, "material": 12}}]}}],
        "nodes": [{{"mesh": 0, "translation": [0, 0, 1], "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes":
            {{"TRANSLATION": {moves}, "ROTATION": {turns}, "SCALE": {scales}}}}}}}}},
            {{"mesh": 0, "children": [2], "extensions": {{"KHR_node_visibility": {{"visible": false}}}}}}, {{"mesh": 0}}],
        "animations": [{{"channels": "nonsense"}}], "textures": [{{}}]"#
    );
    let mesh = made.mesh(&rest).unwrap();
    let second = |x: f32, y: f32| [-3.0 * x, 20.0 - 3.0 * y, 1.0];
    assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
    let expected =
        [[10.0, 0.0, 1.0], [11.0, 0.0, 1.0], [10.0, 1.0, 1.0], second(0.0, 0.0), second(1.0, 0.0), second(0.0, 1.0)];
    for (v, expected) in mesh.vertices.iter().zip(expected) {
        assert!(v.distance(expected.into()) < 1e-5, "{v} {expected:?}");
    }
    let uneven = rest.replace(r#""SCALE": 3"#, r#""SCALE": 0"#);
    assert!(message(made.mesh(&uneven)).contains("its copies have not as many of each attribute"));
    let shown = rest.replace("false", "true");
    assert_eq!(made.mesh(&shown).unwrap().triangles.len(), 4);
}

#[test]
fn quantised_positions_are_what_they_stand_for() {
    let mut made = Made::default();
    let i16s = [0_i16, 0, 0, 32767, 0, 0, 0, -32768, 16384].map(i16::to_le_bytes).concat();
    let plain = made.add(&i16s, 5122, "VEC3", 3, "");
    let normalized = made.add(&i16s, 5122, "VEC3", 3, r#", "normalized": true"#);
    let rest = |accessor: usize| {
        format!(
            r#""nodes": [{{"mesh": 0}}], "extensionsRequired": ["KHR_mesh_quantization"],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": {accessor}}}}}]}}]"#
        )
    };
    let read = vertices(&made.mesh(&rest(plain)).unwrap());
    assert_eq!(read, [[0.0; 3], [32767.0, 0.0, 0.0], [0.0, -32768.0, 16384.0]]);
    #[expect(clippy::cast_possible_truncation, reason = "what is expected")]
    let third = [0.0, -1.0, (16384.0 / 32767.0_f64) as f32];
    assert_eq!(vertices(&made.mesh(&rest(normalized)).unwrap()), [[0.0; 3], [1.0, 0.0, 0.0], third]);
    // And without a scene.
    assert_eq!(notes("glb", made.glb(&rest(plain))), ["f.glb: scenes: there is no scene: every node is taken"]);
    let empty = made.glb(r#""scenes": [{}], "scene": 0, "nodes": [{}]"#);
    assert_eq!(parse("glb", empty).unwrap().triangles.len(), 0);
}

#[test]
fn what_is_compressed_is_refused_by_name() {
    let mut made = Made::default();
    let positions = made.floats(&TRIANGLE, "VEC3", 3);
    made.accessors.push(r#"{"componentType": 5126, "type": "VEC3", "count": 3}"#.into());
    let rest = |accessor: usize| {
        format!(
            r#""nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": {accessor}}},
            "extensions": {{"KHR_draco_mesh_compression": {{"bufferView": 0}}}}}}]}}]"#
        )
    };
    // What stands there without compression is read.
    assert_eq!(made.mesh(&rest(positions)).unwrap().triangles.len(), 1);
    assert_eq!(
        message(made.mesh(&rest(positions + 1))),
        "f.glb: node 0, primitive 0: KHR_draco_mesh_compression is not read; write it without Draco compression"
    );
    for name in ["EXT_meshopt_compression", "KHR_draco_mesh_compression", "MSFT_lod"] {
        let text = message(made.mesh(&format!(r#""extensionsRequired": ["{name}"]"#)));
        assert!(text.starts_with(&format!("f.glb: extensionsRequired: {name} is not read; write ")), "{text}");
    }
}

#[test]
fn data_uris_of_every_kind() {
    let text = |uri: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}], "buffers": [{{"uri": "{uri}", "byteLength": 9}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 9}}], "accessors": [{{"bufferView": 0, "componentType": 5120, "type": "VEC3",
            "count": 3}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}]}}"#
        )
    };
    let known = [[0.0, 1.0, 2.0], [3.0, 65.0, 5.0], [6.0, 7.0, -1.0]];
    for uri in [
        "data:application/octet-stream;base64,AAECA0EFBgf/",
        "data:;base64,AAECA0EFBgf%2F",
        "data:application/gltf-buffer,%00%01%02%03A%05%06%07%ff",
    ] {
        assert_eq!(vertices(&parse("gltf", text(uri)).unwrap()), known, "{uri}");
        assert_eq!(vertices(&parse("gltf", format!("\u{feff}{}", text(uri))).unwrap()), known, "{uri}");
    }
}
