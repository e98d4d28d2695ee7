//! STL, binary and ASCII: the facets in the file's order, three vertices each; normals are not read.
//!
//! Read here and not by stl_io, which takes a binary file whose header begins with `solid ` for ASCII, stops without a
//! word after the first of several solids, refuses the NaN normals that exporters give to facets without area, and
//! does not say where a fault is. The tests compare the two.

use glam::Vec3;

use super::faults::Faults;
use crate::Error;
use rayproof_scene::Mesh;

/// The header and the number of facets.
const HEADER: usize = 84;
/// A normal and three vertices of three f32 each, and two bytes that mean nothing.
const FACET: usize = 50;
const TOO_MANY: &str = "a mesh holds at most 1431655765 facets: split the file";

pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Mesh, Error> {
    // Only the length tells them apart: binary headers may begin with `solid` too.
    let count = bytes.get(HEADER - 4..HEADER).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize);
    let whole = count.is_some_and(|n| n.checked_mul(FACET).is_some_and(|size| bytes.len() - HEADER == size));
    if whole {
        binary(file, &bytes[HEADER..])
    } else if bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        ascii(file, bytes)
    } else {
        let what = match count {
            Some(n) => format!("{n} facets are announced and {} bytes follow", bytes.len() - HEADER),
            None => format!("the file ends after {} bytes", bytes.len()),
        };
        let expected =
            "give a whole file: a binary one has 84 bytes and 50 more a facet, an ASCII one begins with `solid`";
        Err(Error::bad(file, "the header", what, expected))
    }
}

fn binary(file: &str, facets: &[u8]) -> Result<Mesh, Error> {
    let mut faults = Faults::new(file);
    let mut vertices = Vec::with_capacity(facets.len() / FACET * 3);
    for (i, facet) in facets.chunks_exact(FACET).enumerate() {
        for vertex in facet[12..48].chunks_exact(12) {
            let v: Vec3 = bytemuck::pod_read_unaligned::<[[u8; 4]; 3]>(vertex).map(f32::from_le_bytes).into();
            faults.vertex(format_args!("facet {i} (counting from 0)"), v);
            vertices.push(v);
        }
    }
    faults.none()?;
    unwelded(file, vertices)
}

/// The lines that a facet is made of, by their first word.
const FACET_LINES: [&str; 7] = ["facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet"];

fn ascii(file: &str, bytes: &[u8]) -> Result<Mesh, Error> {
    let mut faults = Faults::new(file);
    let mut vertices = Vec::new();
    // Where we are: in a solid or between two, and which line of a facet comes next.
    let (mut inside, mut next) = (false, 0);
    let mut last = 0;
    for (line, text) in (1..).zip(bytes.split(|&b| b == b'\n').map(String::from_utf8_lossy)) {
        let mut words = text.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        last = line;
        let is = |expected| word.eq_ignore_ascii_case(expected);
        if inside && is(FACET_LINES[next]) {
            if is("vertex") {
                vertices.push(vertex(words, line, &mut faults));
            }
            next = (next + 1) % FACET_LINES.len();
        } else if !inside && is("solid") {
            inside = true;
        } else if inside && next == 0 && is("endsolid") {
            inside = false;
        } else {
            let expected = if inside { FACET_LINES[next] } else { "solid" };
            let what = format!("`{}` is out of place", text.trim());
            return Err(Error::bad(file, format!("line {line}"), what, format!("`{expected}` should come here")));
        }
    }
    faults.none()?;
    if inside {
        return Err(Error::bad(
            file,
            format!("line {last}"),
            "the file ends inside a solid",
            "give it up to `endsolid`",
        ));
    }
    unwelded(file, vertices)
}

/// The three numbers of a vertex.
fn vertex<'a>(mut words: impl Iterator<Item = &'a str>, line: usize, faults: &mut Faults<'_>) -> Vec3 {
    let mut number = || words.next().and_then(|word| word.parse().ok());
    let (Some(x), Some(y), Some(z), None) = (number(), number(), number(), words.next()) else {
        faults.add(format_args!("line {line}"), format_args!("this is not three numbers"), "give `vertex x y z`");
        return Vec3::ZERO;
    };
    let v = Vec3::new(x, y, z);
    faults.vertex(format_args!("line {line}"), v);
    v
}

/// Every three vertices are a triangle.
fn unwelded(file: &str, vertices: Vec<Vec3>) -> Result<Mesh, Error> {
    let count = u32::try_from(vertices.len())
        .map_err(|_| Error::bad(file, "the file", format!("{} vertices are too many", vertices.len()), TOO_MANY))?;
    Ok(Mesh { vertices, triangles: (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect() })
}
