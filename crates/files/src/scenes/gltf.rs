//! glTF 2.0 and GLB: every triangle of the default scene, in world space, as one mesh.
//!
//! Nodes are walked from the scene's first, a parent before its children. Materials, skins, morph targets and images
//! are not read. Strips and fans become triangles with the vertex order of the glTF specification, section 3.7.2.1.

use std::path::Path;

use glam::{DMat4, DQuat, DVec3};
use gltf::mesh::Mode;
use gltf::{Document, Node, Primitive, Semantic, scene::Transform};

use super::gltf_data::{Data, document};
use super::reading::{Reading, Vertices};
use crate::Error;
use rayproof_scene::Mesh;

pub(super) fn parse(path: &Path, bytes: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let file = path.display().to_string();
    let (document, blob) = document(&file, bytes)?;
    let data = Data::load(path, &file, &document, blob)?;
    let mut mesh = Mesh::default();
    for (node, world) in nodes(&file, &document)? {
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            let place = format!("node {}, primitive {}", node.index(), primitive.index());
            add(&place, &data, &primitive, world, &mut mesh, &mut reading)?;
        }
    }
    reading.end()?;
    Ok(mesh)
}

/// The nodes of the default scene and their world transforms.
fn nodes<'a>(file: &str, document: &'a Document) -> Result<Vec<(Node<'a>, DMat4)>, Error> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene =
        scene.ok_or_else(|| Error::bad(file, "scenes", "there is no scene", "give a scene with the nodes to load"))?;
    let mut seen = vec![false; document.nodes().len()];
    let mut walk = Vec::new();
    let mut next: Vec<_> = scene.nodes().map(|node| (node, DMat4::IDENTITY)).collect();
    next.reverse();
    while let Some((node, parent)) = next.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            let place = format!("node {}", node.index());
            return Err(Error::bad(file, place, "it is reached twice", "give each node one parent at most"));
        }
        let world = parent * local(&node);
        let first = next.len();
        next.extend(node.children().map(|child| (child, world)));
        next[first..].reverse();
        walk.push((node, world));
    }
    Ok(walk)
}

fn local(node: &Node<'_>) -> DMat4 {
    match node.transform() {
        Transform::Matrix { matrix } => DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from))),
        Transform::Decomposed { translation, rotation, scale } => {
            // A unit quaternion, but only to the precision of an f32.
            let rotation = DQuat::from_array(rotation.map(f64::from)).normalize();
            let [scale, translation] = [scale, translation].map(|v| DVec3::from(v.map(f64::from)));
            DMat4::from_scale_rotation_translation(scale, rotation, translation)
        }
    }
}

/// Appends the triangles of a primitive; points and lines have none.
fn add(
    place: &str,
    data: &Data<'_>,
    primitive: &Primitive<'_>,
    world: DMat4,
    mesh: &mut Mesh,
    reading: &mut Reading<'_>,
) -> Result<(), Error> {
    let mode = primitive.mode();
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(());
    }
    let positions = primitive.get(&Semantic::Positions);
    let positions = positions.ok_or_else(|| data.bad(place, "it has no POSITION", "give its vertices a POSITION"))?;
    let mut vertices = Vertices::default();
    for (i, p) in data.positions(&positions)?.enumerate() {
        let v = world.transform_point3(DVec3::from(p.map(f64::from)));
        vertices.push(v.to_array().map(Into::into), i, reading);
    }
    let count = vertices.len();
    let (Ok(base), Ok(end)) = (u32::try_from(mesh.vertices.len()), u32::try_from(mesh.vertices.len() + count)) else {
        return Err(data.bad(place, "there are more than 4294967295 vertices", "split the file"));
    };
    let indices: Vec<u32> = match primitive.indices() {
        Some(accessor) => data.indices(&accessor)?.collect(),
        None => (0..end - base).collect(),
    };
    let mut out_of_range = indices.iter().enumerate().filter(|&(_, &index)| index as usize >= count).peekable();
    if out_of_range.peek().is_some() {
        let expected = format!("it has {count} vertices: give indices from 0 and below {count}");
        for (i, index) in out_of_range {
            let what = format_args!("vertex {index} is out of range");
            reading.fault(format_args!("{place}, index {i} (counting from 0)"), what, &expected);
        }
        return Ok(());
    }
    let mut triangles = Vec::new();
    let mut push = |corners: [usize; 3]| triangles.push(corners.map(|i| indices[i]));
    let count = indices.len();
    match mode {
        Mode::Triangles if !count.is_multiple_of(3) => {
            let what = format!("{count} vertices are not whole triangles");
            return Err(data.bad(place, what, "give three a triangle"));
        }
        Mode::Triangles => (0..count / 3).for_each(|i| push([3 * i, 3 * i + 1, 3 * i + 2])),
        Mode::TriangleStrip => (0..count.saturating_sub(2)).for_each(|i| push([i, i + 1 + i % 2, i + 2 - i % 2])),
        _ => (0..count.saturating_sub(2)).for_each(|i| push([i + 1, i + 2, 0])),
    }
    let vertex = |i| format!("{place}, vertex {i} in world space (counting from 0)");
    let part = vertices.mesh(triangles, vertex, reading);
    mesh.vertices.extend(part.vertices);
    mesh.triangles.extend(part.triangles.into_iter().map(|corners| corners.map(|corner| base + corner)));
    Ok(())
}
