//! PLY, ASCII and both binaries: the header by ply-rs-bw, the values by [`Payload`].

use glam::Vec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, ElementDef, Header, PropertyType, ScalarType};

use super::faults::nearest;
use super::obj::fan;
use super::ply_payload::Payload;
use crate::Error;
use rayproof_scene::Mesh;

pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Mesh, Error> {
    let (header, rest) = header(file, bytes)?;
    let total = header.elements.get("vertex").map_or(0, |vertex| vertex.count);
    let mut payload = Payload::new(file, rest, header.encoding);
    let mut mesh = Mesh::default();
    for element in header.elements.values() {
        match element.name.as_str() {
            "vertex" => mesh.vertices = vertices(file, element, &mut payload)?,
            "face" => mesh.triangles = faces(file, element, total, &mut payload)?,
            "tristrips" => {
                let what = "triangle strips are not read";
                return Err(Error::bad(file, "element `tristrips`", what, "give the triangles as element `face`"));
            }
            _ => payload.elements(element, |_, _, _| {})?,
        }
    }
    payload.end()?;
    Ok(mesh)
}

/// The header, and what comes after it.
fn header<'a>(file: &str, bytes: &'a [u8]) -> Result<(Header, &'a [u8]), Error> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<DefaultElement>::new().read_header(&mut reader).map_err(|e| {
        let place = e.line().map_or("the header".into(), |line| format!("line {line}"));
        let message = e.to_string();
        let what = message.lines().next().unwrap_or_default();
        let what = e.line().and_then(|_| what.split_once(": ")).map_or(what, |(_, what)| what);
        Error::bad(file, place, what, "give a PLY header: ply, format, element, property, end_header")
    })?;
    let rest = reader.into_inner();
    // The parser keeps only the last of two elements or properties of one name, but the payload holds both.
    let text = String::from_utf8_lossy(&bytes[..bytes.len() - rest.len()]);
    let words = text.lines().filter_map(|line| line.split_ascii_whitespace().next());
    let declared = words.filter(|word| ["element", "property"].contains(word)).count();
    let kept: usize = header.elements.values().map(|e| 1 + e.properties.len()).sum();
    if declared != kept {
        let expected = "give each element, and each property of an element, a name of its own";
        return Err(Error::bad(file, "the header", "a name is declared twice", expected));
    }
    Ok((header, rest))
}

fn vertices(file: &str, element: &ElementDef, payload: &mut Payload<'_>) -> Result<Vec<Vec3>, Error> {
    let scalar = |name| {
        let found = element.properties.get_full(name);
        found.filter(|(.., p)| matches!(p.data_type, PropertyType::Scalar(_))).map(|(index, ..)| index)
    };
    let (Some(x), Some(y), Some(z)) = (scalar("x"), scalar("y"), scalar("z")) else {
        return Err(Error::bad(file, "element `vertex`", "x, y or z is missing", "declare them as `property float`"));
    };
    let mut vertices = Vec::with_capacity(payload.at_most(element.count));
    payload.elements(element, |i, row, faults| {
        let v = Vec3::from([x, y, z].map(|index| nearest(row.scalars[index])));
        faults.vertex(format_args!("vertex {i} (counting from 0)"), v);
        vertices.push(v);
    })?;
    Ok(vertices)
}

fn faces(file: &str, element: &ElementDef, total: usize, payload: &mut Payload<'_>) -> Result<Vec<[u32; 3]>, Error> {
    let list = ["vertex_indices", "vertex_index"].into_iter().find_map(|name| element.properties.get_full(name));
    let Some((list, ..)) = list.filter(|(.., p)| is_integer_list(&p.data_type)) else {
        let what = "vertex_indices is missing or not a list of integers";
        return Err(Error::bad(file, "element `face`", what, "declare `property list uchar int vertex_indices`"));
    };
    let expected = format!("the header declares {total} vertices: give indices from 0 and below {total}");
    let mut triangles = Vec::with_capacity(payload.at_most(element.count));
    let mut corners = Vec::new();
    payload.elements(element, |i, row, faults| {
        let place = format_args!("face {i} (counting from 0)");
        corners.clear();
        for &index in &row.lists[list] {
            match vertex(index).filter(|&v| (v as usize) < total) {
                Some(v) => corners.push(v),
                None => return faults.add(place, format_args!("vertex {index} is out of range"), &expected),
            }
        }
        if corners.len() < 3 {
            let what = format_args!("it has only {} vertices", corners.len());
            faults.add(place, what, "give a face three vertices or more");
        }
        triangles.extend(fan(&corners));
    })?;
    Ok(triangles)
}

const fn is_integer_list(ty: &PropertyType) -> bool {
    matches!(ty, PropertyType::List(_, of) if !matches!(of, ScalarType::Float | ScalarType::Double))
}

/// An index of any of PLY's integer types, as the payload gives it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an integer in the range of u32")]
fn vertex(index: f64) -> Option<u32> {
    (0.0..=f64::from(u32::MAX)).contains(&index).then_some(index as u32)
}
