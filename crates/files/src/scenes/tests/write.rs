//! Writers of the formats, as plain as the formats allow.

use std::fmt::Write;

use rayproof_scene::{Mesh, Sphere};

pub(super) fn obj(mesh: &Mesh) -> String {
    let mut text = String::from("# a mesh\no name\n");
    for v in &mesh.vertices {
        writeln!(text, "v {} {} {}", v.x, v.y, v.z).unwrap();
    }
    for t in &mesh.triangles {
        writeln!(text, "f {} {} {}", t[0] + 1, t[1] + 1, t[2] + 1).unwrap();
    }
    text
}

/// `format` is one of PLY's three names; the vertices get a property more, the faces an element before them.
pub(super) fn ply(mesh: &Mesh, format: &str, real: &str) -> Vec<u8> {
    let (vertices, faces) = (mesh.vertices.len(), mesh.triangles.len());
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment by hand\nelement vertex {vertices}\nproperty {real} x\nproperty {real} y\n\
         property uchar red\nproperty {real} z\nelement edge 1\nproperty short a\nproperty list uchar float b\n\
         element face {faces}\nproperty list ushort uint vertex_indices\nend_header\n"
    )
    .into_bytes();
    let real = |x: f32| if real == "double" { Value::F64(x.into()) } else { Value::F32(x) };
    let mut rows: Vec<Vec<Value>> =
        mesh.vertices.iter().map(|v| vec![real(v.x), real(v.y), Value::U8(7), real(v.z)]).collect();
    rows.push(vec![Value::I16(-3), Value::U8(1), Value::F32(0.5)]);
    rows.extend(mesh.triangles.iter().map(|t| [Value::U16(3)].into_iter().chain(t.map(Value::U32)).collect()));
    for row in rows {
        for value in &row {
            value.write(format, &mut bytes);
        }
        if format == "ascii" {
            bytes.push(b'\n');
        }
    }
    bytes
}

enum Value {
    U8(u8),
    I16(i16),
    U16(u16),
    U32(u32),
    F32(f32),
    F64(f64),
}

impl Value {
    fn write(&self, format: &str, to: &mut Vec<u8>) {
        let (text, mut bytes) = match self {
            Self::U8(x) => (x.to_string(), x.to_le_bytes().to_vec()),
            Self::I16(x) => (x.to_string(), x.to_le_bytes().to_vec()),
            Self::U16(x) => (x.to_string(), x.to_le_bytes().to_vec()),
            Self::U32(x) => (x.to_string(), x.to_le_bytes().to_vec()),
            Self::F32(x) => (x.to_string(), x.to_le_bytes().to_vec()),
            Self::F64(x) => (x.to_string(), x.to_le_bytes().to_vec()),
        };
        match format {
            "ascii" => to.extend(format!("{text} ").bytes()),
            "binary_little_endian" => to.extend(bytes),
            _ => {
                bytes.reverse();
                to.extend(bytes);
            }
        }
    }
}

pub(super) fn stl_ascii(mesh: &Mesh) -> String {
    let mut text = String::from("solid name\n");
    for t in 0..mesh.triangles.len() {
        text += "  facet normal 0 0 0\n    outer loop\n";
        let t = mesh.triangle(t);
        for v in [t.a, t.b, t.c] {
            writeln!(text, "      vertex {} {} {}", v.x, v.y, v.z).unwrap();
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid name\n"
}

pub(super) fn stl_binary(mesh: &Mesh, header: &str) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, 0);
    bytes.extend(u32::try_from(mesh.triangles.len()).unwrap().to_le_bytes());
    for t in 0..mesh.triangles.len() {
        let t = mesh.triangle(t);
        bytes.extend([0; 12]);
        bytes.extend([t.a, t.b, t.c].iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

/// A GLB of JSON and a binary chunk.
pub(super) fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8], pad: u8| {
        let mut data = data.to_vec();
        data.resize(data.len().next_multiple_of(4), pad);
        [&u32::try_from(data.len()).unwrap().to_le_bytes(), &kind[..], &data].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes(), b' '), chunk(b"BIN\0", bin, 0)].concat();
    let length = u32::try_from(12 + chunks.len()).unwrap();
    [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes(), &chunks].concat()
}

/// The JSON and the binary chunk of one node with one primitive; `node`, `primitive` and `root` are more JSON fields,
/// each with a comma before it.
pub(super) fn gltf(mesh: &Mesh, node: &str, primitive: &str, root: &str) -> (String, Vec<u8>) {
    let positions: Vec<u8> = mesh.vertices.iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes).collect();
    let indices: Vec<u8> = mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
    let (split, length) = (positions.len(), positions.len() + indices.len());
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0{node}}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1{primitive}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": {}}},
                      {{"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": {}}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {split}}},
                        {{"buffer": 0, "byteOffset": {split}, "byteLength": {}}}],
        "buffers": [{{"byteLength": {length}}}]{root}}}"#,
        mesh.vertices.len(),
        mesh.triangles.len() * 3,
        indices.len(),
    );
    (json, [positions, indices].concat())
}

/// `descr` is the dtype, `shape` the Python tuple.
pub(super) fn npy(descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}

pub(super) fn row(s: &Sphere) -> [f32; 4] {
    [s.center.x, s.center.y, s.center.z, s.radius]
}
