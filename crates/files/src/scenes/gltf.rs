//! glTF 2.0 and GLB: every triangle of the default scene, in world space, as one mesh.
//!
//! Nodes are walked from the scene's first, a parent before its children. What moves a vertex is honoured: skins in the pose that
//! the nodes have, the default weights of morph targets, quantised positions, copies by `EXT_mesh_gpu_instancing`, and
//! `KHR_node_visibility`. Materials, animation, cameras and images are not read. Strips and fans become triangles with the vertex
//! order of the glTF specification, section 3.7.2.1.

use std::path::Path;

use glam::{DMat4, DQuat, DVec3};

use super::gltf_data::Data;
use super::gltf_json::{self, DRACO, Node, PrimitiveJson, Root};
use super::reading::{Reading, Vertices};
use crate::Error;
use rayproof_scene::Mesh;

pub(super) fn parse(path: &Path, bytes: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let file = path.display().to_string();
    let (root, binary) = gltf_json::read(&file, bytes)?;
    let data = Data::new(path, &file, &root, binary);
    let pose = Pose::new(&data, &root, &mut reading)?;
    let mut mesh = Mesh::default();
    for &(node, world) in &pose.shown {
        let Some(index) = root.nodes[node].mesh else { continue };
        let bodies = pose.bodies(&data, node, world)?;
        for (i, primitive) in data.get(&root.meshes, "mesh", index)?.primitives.iter().enumerate() {
            let place = format!("node {node}, primitive {i}");
            let mode = primitive.mode.unwrap_or(4);
            match mode {
                // Points and lines.
                0..=3 => continue,
                4..=6 => {}
                _ => return Err(data.bad(place, format!("its mode is {mode}"), "give a mode from 0 to 6")),
            }
            let weights = root.nodes[node].weights.as_ref().unwrap_or(&root.meshes[index].weights);
            let shape = Shape::new(&data, &place, primitive, weights)?;
            let Some(triangles) = shape.triangles(&data, &place, primitive, mode, &mut reading)? else { continue };
            for body in &bodies {
                let placed = shape.placed(&data, &place, primitive, body)?;
                add(&data, &place, &placed, &triangles, &mut mesh, &mut reading)?;
            }
        }
    }
    reading.end()?;
    Ok(mesh)
}

/// Where the nodes are.
struct Pose<'a> {
    root: &'a Root,
    /// Of every node that the scene reaches.
    worlds: Vec<Option<DMat4>>,
    /// Those that are shown, in the order of the walk.
    shown: Vec<(usize, DMat4)>,
}

/// What places a mesh.
enum Body {
    /// A transform of the whole.
    Rigid(DMat4),
    /// One of each joint.
    Skinned(Vec<DMat4>),
}

impl<'a> Pose<'a> {
    fn new(data: &Data<'_>, root: &'a Root, reading: &mut Reading<'_>) -> Result<Self, Error> {
        let starts = match (root.scenes.get(root.scene.unwrap_or(0)), root.scene) {
            (Some(scene), _) => scene.nodes.clone(),
            (None, Some(scene)) => {
                let what = format!("scene {scene} is out of range");
                return Err(data.bad("scene", what, "give the number of a scene"));
            }
            // Without a scene nothing says what is to be seen: all there is.
            (None, None) => {
                if !root.nodes.is_empty() {
                    reading.note(format_args!("scenes"), "there is no scene: every node is taken");
                }
                let mut is_child = vec![false; root.nodes.len()];
                let children = root.nodes.iter().flat_map(|node| &node.children);
                children.for_each(|&child| is_child.get_mut(child).into_iter().for_each(|is| *is = true));
                (0..root.nodes.len()).filter(|&node| !is_child[node]).collect()
            }
        };
        let (mut worlds, mut shown) = (vec![None; root.nodes.len()], Vec::new());
        let mut next: Vec<_> = starts.into_iter().map(|node| (node, DMat4::IDENTITY, true)).collect();
        next.reverse();
        while let Some((index, parent, visible)) = next.pop() {
            let node = data.get(&root.nodes, "node", index)?;
            if worlds[index].is_some() {
                let place = format!("node {index}");
                return Err(data.bad(place, "it is reached twice", "give each node one parent at most"));
            }
            let world = parent * local(node);
            let hidden =
                node.extensions.get("KHR_node_visibility").and_then(|e| e.get("visible")?.as_bool()) == Some(false);
            let visible = visible && !hidden;
            let first = next.len();
            next.extend(node.children.iter().map(|&child| (child, world, visible)));
            next[first..].reverse();
            worlds[index] = Some(world);
            shown.extend(visible.then_some((index, world)));
        }
        Ok(Self { root, worlds, shown })
    }

    /// What places the mesh of a node: its skin, whose joints alone say where it is; else its copies; else itself.
    fn bodies(&self, data: &Data<'_>, index: usize, world: DMat4) -> Result<Vec<Body>, Error> {
        let node = &self.root.nodes[index];
        let copies = node.extensions.get("EXT_mesh_gpu_instancing");
        match (node.skin, copies) {
            (Some(_), Some(_)) => {
                let what = "it has a skin and copies";
                Err(data.bad(
                    format!("node {index}"),
                    what,
                    "give one or the other: no specification says what both mean",
                ))
            }
            (Some(skin), None) => Ok(vec![Body::Skinned(self.joints(data, skin)?)]),
            (None, Some(copies)) => {
                let accessor = |name: &str| copies.get("attributes")?.get(name)?.as_u64()?.try_into().ok();
                copies_of(data, index, ["TRANSLATION", "ROTATION", "SCALE"].map(accessor))
                    .map(|copies| copies.into_iter().map(|copy| Body::Rigid(world * copy)).collect())
            }
            (None, None) => Ok(vec![Body::Rigid(world)]),
        }
    }

    /// The matrices of a skin's joints: from the pose in which it was bound to where the joint is.
    fn joints(&self, data: &Data<'_>, skin: usize) -> Result<Vec<DMat4>, Error> {
        let place = format!("skin {skin}");
        let skin = data.get(&self.root.skins, "skin", skin)?;
        let inverse: Vec<DMat4> = match skin.inverse_bind_matrices {
            Some(accessor) => data.vectors::<16>(accessor, "MAT4")?.iter().map(DMat4::from_cols_array).collect(),
            None => vec![DMat4::IDENTITY; skin.joints.len()],
        };
        if inverse.len() < skin.joints.len() {
            let what = format!("it has {} joints and {} inverse bind matrices", skin.joints.len(), inverse.len());
            return Err(data.bad(place, what, "give one a joint"));
        }
        let joint = |(&joint, inverse): (&usize, &DMat4)| {
            let world = data.get(&self.worlds, "joint", joint)?.ok_or_else(|| {
                data.bad(&place, format!("its joint, node {joint}, is not in the scene"), "put it into the scene")
            })?;
            Ok(world * *inverse)
        };
        skin.joints.iter().zip(&inverse).map(joint).collect()
    }
}

fn local(node: &Node) -> DMat4 {
    match node.matrix {
        Some(matrix) => DMat4::from_cols_array(&matrix),
        None => transform(
            node.translation.unwrap_or_default(),
            node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            node.scale.unwrap_or([1.0; 3]),
        ),
    }
}

fn transform(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> DMat4 {
    // A unit quaternion, but only to the precision of an f32.
    let rotation = DQuat::from_array(rotation).normalize();
    DMat4::from_scale_rotation_translation(scale.into(), rotation, translation.into())
}

/// The transforms of copies; each attribute may be left out, and those that are there have as many values.
fn copies_of(
    data: &Data<'_>,
    node: usize,
    [move_by, turn_by, scale_by]: [Option<usize>; 3],
) -> Result<Vec<DMat4>, Error> {
    let moves = move_by.map(|accessor| data.vectors::<3>(accessor, "VEC3")).transpose()?;
    let turns = turn_by.map(|accessor| data.vectors::<4>(accessor, "VEC4")).transpose()?;
    let scales = scale_by.map(|accessor| data.vectors::<3>(accessor, "VEC3")).transpose()?;
    let counts = [moves.as_ref().map(Vec::len), turns.as_ref().map(Vec::len), scales.as_ref().map(Vec::len)];
    let count = counts.into_iter().flatten().max().unwrap_or(0);
    if counts.into_iter().flatten().any(|n| n != count) {
        let what = "its copies have not as many of each attribute";
        return Err(data.bad(format!("node {node}"), what, "give as many translations, rotations and scales"));
    }
    let at = |i: usize| {
        transform(
            moves.as_ref().map_or([0.0; 3], |moves| moves[i]),
            turns.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |turns| turns[i]),
            scales.as_ref().map_or([1.0; 3], |scales| scales[i]),
        )
    };
    Ok((0..count).map(at).collect())
}

/// The vertices of a primitive, morphed, before anything places them.
struct Shape(Vec<DVec3>);

impl Shape {
    fn new(data: &Data<'_>, place: &str, primitive: &PrimitiveJson, weights: &[f64]) -> Result<Self, Error> {
        let positions = primitive.attributes.get("POSITION");
        let &positions =
            positions.ok_or_else(|| data.bad(place, "it has no POSITION", "give its vertices a POSITION"))?;
        if primitive.extensions.contains_key(DRACO) && !data.has_view(positions) {
            return Err(data.bad(place, format!("{DRACO} is not read"), "write it without Draco compression"));
        }
        let mut vertices: Vec<DVec3> = data.vectors::<3>(positions, "VEC3")?.into_iter().map(DVec3::from).collect();
        let targets = primitive.targets.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0);
        for (&target, &weight) in targets.filter_map(|(target, weight)| Some((target.get("POSITION")?, weight))) {
            let moves = data.vectors::<3>(target, "VEC3")?;
            if moves.len() != vertices.len() {
                let what = format!("it has {} vertices and a morph target {}", vertices.len(), moves.len());
                return Err(data.bad(place, what, "give as many of each"));
            }
            vertices.iter_mut().zip(moves).for_each(|(v, by)| *v += weight * DVec3::from(by));
        }
        Ok(Self(vertices))
    }

    /// The triangles over the vertices in a mode of 4 (triangles), 5 (a strip) or 6 (a fan); none where one of the indices is bad,
    /// which is told.
    fn triangles(
        &self,
        data: &Data<'_>,
        place: &str,
        primitive: &PrimitiveJson,
        mode: u32,
        reading: &mut Reading<'_>,
    ) -> Result<Option<Vec<[u32; 3]>>, Error> {
        let count = self.0.len();
        let indices = match primitive.indices {
            Some(accessor) => data.indices(accessor)?,
            None => (0..).take(count).collect(),
        };
        let mut out_of_range = indices.iter().enumerate().filter(|&(_, &index)| index as usize >= count).peekable();
        if out_of_range.peek().is_some() {
            let expected = format!("it has {count} vertices: give indices from 0 and below {count}");
            for (i, index) in out_of_range {
                let what = format_args!("vertex {index} is out of range");
                reading.fault(format_args!("{place}, index {i} (counting from 0)"), what, &expected);
            }
            return Ok(None);
        }
        if mode == 4 && !indices.len().is_multiple_of(3) {
            let what = format!("{} vertices are not whole triangles", indices.len());
            return Err(data.bad(place, what, "give three a triangle"));
        }
        let triangles = if mode == 4 { indices.len() / 3 } else { indices.len().saturating_sub(2) };
        let corners = |i: usize| match mode {
            4 => [3 * i, 3 * i + 1, 3 * i + 2],
            5 => [i, i + 1 + i % 2, i + 2 - i % 2],
            _ => [i + 1, i + 2, 0],
        };
        Ok(Some((0..triangles).map(|i| corners(i).map(|corner| indices[corner])).collect()))
    }

    /// In world space.
    fn placed(
        &self,
        data: &Data<'_>,
        place: &str,
        primitive: &PrimitiveJson,
        body: &Body,
    ) -> Result<Vec<DVec3>, Error> {
        let joints = match body {
            Body::Rigid(world) => return Ok(self.0.iter().map(|&v| world.transform_point3(v)).collect()),
            Body::Skinned(joints) => joints,
        };
        let mut placed = vec![DVec3::ZERO; self.0.len()];
        for set in 0.. {
            let name = |of: &str| primitive.attributes.get(&format!("{of}_{set}"));
            let (Some(&numbers), Some(&weights)) = (name("JOINTS"), name("WEIGHTS")) else {
                if set == 0 {
                    return Err(data.bad(place, "its node has a skin, and it no JOINTS_0 and WEIGHTS_0", "give both"));
                }
                break;
            };
            let (numbers, weights) = (data.vectors::<4>(numbers, "VEC4")?, data.vectors::<4>(weights, "VEC4")?);
            if numbers.len() != self.0.len() || weights.len() != self.0.len() {
                let what = format!(
                    "it has {} vertices, joints of {}, weights of {}",
                    self.0.len(),
                    numbers.len(),
                    weights.len()
                );
                return Err(data.bad(place, what, "give as many of each"));
            }
            for ((v, placed), (numbers, weights)) in self.0.iter().zip(&mut placed).zip(numbers.iter().zip(&weights)) {
                for (&number, &weight) in numbers.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0) {
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an unsigned integer")]
                    let joint = data.get(joints, place, number as usize)?;
                    *placed += weight * joint.transform_point3(*v);
                }
            }
        }
        Ok(placed)
    }
}

/// Appends the triangles of a primitive, once it is placed.
fn add(
    data: &Data<'_>,
    place: &str,
    placed: &[DVec3],
    triangles: &[[u32; 3]],
    mesh: &mut Mesh,
    reading: &mut Reading<'_>,
) -> Result<(), Error> {
    let base = u32::try_from(mesh.vertices.len());
    let (Ok(base), Ok(_)) = (base, u32::try_from(mesh.vertices.len() + placed.len())) else {
        return Err(data.bad(place, "there are more than 4294967295 vertices", "split the file"));
    };
    let mut vertices = Vertices::with_capacity(placed.len());
    for (i, v) in placed.iter().enumerate() {
        vertices.push(v.to_array().map(Into::into), i, reading);
    }
    let vertex = |i| format!("{place}, vertex {i} in world space (counting from 0)");
    let part = vertices.mesh(triangles.to_vec(), vertex, reading);
    mesh.vertices.extend(part.vertices);
    mesh.triangles.extend(part.triangles.into_iter().map(|corners| corners.map(|corner| base + corner)));
    Ok(())
}
