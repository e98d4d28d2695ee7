//! STL, binary and ASCII: the facets in the file's order, three vertices each; normals are not read.
//!
//! Read here and not by stl_io, which takes a binary file whose header begins with `solid ` for ASCII, stops without a
//! word after the first of several solids, refuses the NaN normals that exporters give to facets without area, and
//! does not say where a fault is. The tests compare the two.

use super::lines::{lines, text, words};
use super::reading::{Reading, Vertices};
use crate::Error;
use crate::decimal::Number;
use crate::quote::quoted;
use rayproof_scene::Mesh;

/// The header and the number of facets.
const HEADER: usize = 84;
/// A normal and three vertices of three f32 each, and two bytes that mean nothing.
const FACET: usize = 50;
const NO_END: &str = "`endsolid` is missing";
const TOO_MANY: &str = "a mesh holds at most 1431655765 facets: split the file";

pub(super) fn parse(file: &str, bytes: &[u8], reading: Reading<'_>) -> Result<Mesh, Error> {
    let count = bytes.get(HEADER - 4..HEADER).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize);
    let there = bytes.len().saturating_sub(HEADER);
    let announced = count.and_then(|count| count.checked_mul(FACET));
    // Binary headers may begin with `solid` too: the length tells, and where it says nothing, the bytes do.
    if announced == Some(there) {
        return binary(file, &bytes[HEADER..], reading);
    }
    let start = text(bytes);
    let solid = words(start).next().is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if solid && !start.iter().take(1000).any(|&byte| byte < b'\t') {
        return ascii(file, bytes, reading);
    }
    match (announced, count) {
        (Some(size), Some(count)) if size < there && count > 0 => {
            let mut reading = reading;
            let what = format!("{} bytes after the last facet are left out", there - size);
            reading.note(format_args!("the end of the file"), &what);
            binary(file, &bytes[HEADER..][..size], reading)
        }
        (_, Some(count)) => {
            let what = format!("it is binary, announces {count} facets, and {there} bytes follow");
            Err(Error::bad(file, "the header", what, "give a whole file: 84 bytes, and 50 more a facet"))
        }
        _ => {
            let what = format!("the file ends after {} bytes", bytes.len());
            let expected =
                "give a whole file: a binary one has 84 bytes and 50 more a facet, an ASCII one begins with `solid`";
            Err(Error::bad(file, "the header", what, expected))
        }
    }
}

fn binary(file: &str, facets: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let mut vertices = Vertices::with_capacity(facets.len() / FACET * 3);
    for (i, facet) in facets.chunks_exact(FACET).enumerate() {
        for vertex in facet[12..48].chunks_exact(12) {
            let v = bytemuck::pod_read_unaligned::<[[u8; 4]; 3]>(vertex).map(|x| f32::from_le_bytes(x).into());
            vertices.push(v, i, &mut reading);
        }
    }
    unwelded(file, vertices, |i| format!("facet {i} (counting from 0)"), reading)
}

/// The statements that a facet is made of: their first words, and how many follow.
const STATEMENTS: [(&str, usize); 7] =
    [("facet", 4), ("outer", 1), ("vertex", 3), ("vertex", 3), ("vertex", 3), ("endloop", 0), ("endfacet", 0)];

fn ascii(file: &str, bytes: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let mut vertices = Vertices::default();
    // Where we are: in a solid or between two, and which statement of a facet comes next.
    let (mut inside, mut next) = (false, 0);
    let mut solids = 0;
    for line in lines(bytes) {
        let number = line.number;
        let mut words = words(line.text);
        // Several statements may share a line.
        while let Some(word) = words.next() {
            let is = |expected: &str| word.eq_ignore_ascii_case(expected.as_bytes());
            let (expected, operands) = STATEMENTS[next];
            if inside && is(expected) {
                let operands: Vec<&[u8]> = words.by_ref().take(operands).collect();
                if is("vertex") {
                    vertices.push(vertex(&operands, number, &mut reading), number, &mut reading);
                }
                next = (next + 1) % STATEMENTS.len();
            } else if next == 0 && is("solid") {
                if inside {
                    reading.note(format_args!("line {number}"), NO_END);
                }
                (inside, solids) = (true, solids + 1);
                // Its name, and maybe its first facet.
                let Some(name) = before(words.clone(), &[b"facet", b"normal"]) else { break };
                words.by_ref().take(name).for_each(drop);
            } else if inside && next == 0 && is("endsolid") {
                inside = false;
                // Its name, and maybe another solid.
                let Some(name) = before(words.clone(), &[b"solid"]) else { break };
                if before(words.clone(), &[b"facet", b"normal"]).is_none() {
                    break;
                }
                words.by_ref().take(name).for_each(drop);
            } else if next == 0 && (word.starts_with(b"#") || word.starts_with(b"//") || is("color")) {
                break;
            } else if !inside && solids > 0 && !STATEMENTS.iter().any(|(first, _)| is(first)) {
                reading.note(format_args!("line {number}"), "text after the end of a solid is left out");
                break;
            } else {
                let expected = if inside { expected } else { "solid" };
                reading.end()?;
                let what = format!("{} is out of place", quoted(line.text));
                return Err(Error::bad(file, format!("line {number}"), what, format!("`{expected}` should come here")));
            }
        }
    }
    if next > 0 {
        reading.end()?;
        let what = format!("the file ends inside facet {} (counting from 0)", vertices.len() / 3);
        return Err(Error::bad(file, "the end of the file", what, "give it up to `endsolid`"));
    }
    if inside {
        reading.note(format_args!("the end of the file"), NO_END);
    }
    unwelded(file, vertices, |line| format!("line {line}"), reading)
}

/// How many words stand before these.
fn before<'a>(words: impl Iterator<Item = &'a [u8]>, these: &[&[u8]]) -> Option<usize> {
    let words: Vec<&[u8]> = words.collect();
    words.windows(these.len()).position(|window| window.iter().zip(these).all(|(a, b)| a.eq_ignore_ascii_case(b)))
}

/// The three numbers of a vertex.
fn vertex(words: &[&[u8]], line: usize, reading: &mut Reading<'_>) -> [Number; 3] {
    let numbers: Vec<Number> = words.iter().filter_map(|word| Number::parse(word)).collect();
    <[Number; 3]>::try_from(numbers).unwrap_or_else(|_| {
        reading.fault(format_args!("line {line}"), format_args!("this is not three numbers"), "give `vertex x y z`");
        Default::default()
    })
}

/// Every three vertices are a triangle.
fn unwelded(
    file: &str,
    vertices: Vertices,
    place: impl Fn(usize) -> String,
    mut reading: Reading<'_>,
) -> Result<Mesh, Error> {
    let count = u32::try_from(vertices.len())
        .map_err(|_| Error::bad(file, "the file", format!("{} vertices are too many", vertices.len()), TOO_MANY))?;
    let triangles = (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = vertices.mesh(triangles, place, &mut reading);
    reading.end()?;
    Ok(mesh)
}
