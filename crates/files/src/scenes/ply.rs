//! PLY, ASCII and both binaries: vertices, faces and triangle strips.

use super::faces::Faces;
use super::ply_header::{Element, PlyHeader, Type};
use super::ply_payload::{Payload, Whole};
use super::reading::{Reading, Vertices};
use crate::Error;
use rayproof_scene::Mesh;

pub(super) fn parse(file: &str, bytes: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let (header, rest) = PlyHeader::read(file, bytes)?;
    let total = header.element("vertex").map_or(0, |vertex| vertex.count);
    let mut payload = Payload::new(rest, header.encoding);
    let (mut vertices, mut faces) = (Vertices::default(), Faces::default());
    for element in &header.elements {
        let read = match element.name.as_str() {
            "vertex" => read_vertices(file, element, &mut payload, &mut reading, &mut vertices)?,
            "face" | "tristrips" => read_faces(file, element, total, &mut payload, &mut reading, &mut faces)?,
            _ => payload.skip(element),
        };
        if let Err(i) = read {
            reading.end()?;
            let what =
                format!("the file ends here, or a list has a negative length; the header declares {}", element.count);
            return Err(Error::bad(file, place(&element.name, i), what, "give the whole file"));
        }
    }
    if let Some([place, what]) = payload.end(&mut reading) {
        reading.end()?;
        return Err(Error::bad(
            file,
            place,
            what,
            "give one line an element, with the values that the header declares",
        ));
    }
    let mesh = faces.mesh(vertices, |i| place("face", i), |i| place("vertex", i), &mut reading);
    reading.end()?;
    Ok(mesh)
}

fn place(element: &str, i: usize) -> String {
    format!("{element} {i} (counting from 0)")
}

fn read_vertices(
    file: &str,
    element: &Element,
    payload: &mut Payload<'_>,
    reading: &mut Reading<'_>,
    vertices: &mut Vertices,
) -> Result<Whole, Error> {
    let mut axes = [0; 3];
    for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
        let found = element.property(file, name)?;
        let Some(i) = found.filter(|&i| matches!(element.properties[i].ty, Type::Scalar(_))) else {
            let what = "x, y or z is missing";
            return Err(Error::bad(file, "element `vertex`", what, "declare them as `property float`"));
        };
        *axis = i;
    }
    *vertices = Vertices::with_capacity(payload.at_most(element.count));
    Ok(payload.points(element, axes, reading, |i, point, reading| vertices.push(point, i, reading)))
}

fn read_faces(
    file: &str,
    element: &Element,
    total: usize,
    payload: &mut Payload<'_>,
    reading: &mut Reading<'_>,
    faces: &mut Faces,
) -> Result<Whole, Error> {
    let name = &element.name;
    let list = match element.property(file, "vertex_indices")? {
        None => element.property(file, "vertex_index")?,
        found => found,
    };
    let is_integer_list = |&i: &usize| matches!(element.properties[i].ty, Type::List(_, of) if of.is_integer());
    let Some(list) = list.filter(is_integer_list) else {
        let what = "vertex_indices is missing or not a list of integers";
        return Err(Error::bad(
            file,
            format!("element `{name}`"),
            what,
            "declare `property list uchar int vertex_indices`",
        ));
    };
    let expected = match total {
        0 => "the header declares no vertices: give them as element `vertex`".to_owned(),
        _ => format!("the header declares {total} vertices: give indices from 0 and below {total}"),
    };
    let strips = name == "tristrips";
    if !strips && faces.is_empty() {
        *faces = Faces::with_capacity(payload.at_most(element.count));
    }
    let mut corners: Vec<u32> = Vec::new();
    Ok(payload.lists(element, list, reading, |i, indices, reading| {
        corners.clear();
        for &index in indices {
            match u32::try_from(index).ok().filter(|&corner| (corner as usize) < total) {
                Some(corner) => corners.push(corner),
                // A new strip begins.
                None if strips && index == -1 => {
                    faces.push_strip(&corners);
                    corners.clear();
                }
                None => {
                    let place = place(name, i);
                    return reading.fault(
                        format_args!("{place}"),
                        format_args!("vertex {index} is out of range"),
                        &expected,
                    );
                }
            }
        }
        if strips { faces.push_strip(&corners) } else { faces.push(&corners, i) }
    }))
}
