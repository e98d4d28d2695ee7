//! Wavefront OBJ: the `v` and `f` statements of the format's specification, version 3.0.
//!
//! Read here and not by tobj, which drops vertices that no face uses (and with them their NaN), hashes every corner,
//! and reports neither the line of a fault nor how many there are. The tests compare the two.

use std::borrow::Cow;

use super::faces::Faces;
use super::lines::{Line, Lines, lines, words};
use super::reading::{Reading, Vertices};
use crate::Error;
use crate::decimal::Number;
use crate::quote::quoted;
use rayproof_scene::Mesh;

/// Statements that hold no triangle.
const NO_SURFACE: [&[u8]; 19] = [
    b"vt",
    b"vn",
    b"vp",
    b"p",
    b"l",
    b"o",
    b"g",
    b"s",
    b"mg",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"shadow_obj",
    b"trace_obj",
];

/// Statements that hold a surface, or may, and that are not read.
const OTHER_SURFACE: [&[u8]; 5] = [b"surf", b"bsp", b"bzp", b"call", b"csh"];

const FACE: &str = "give a face as v, v/vt, v//vn or v/vt/vn";
const VERTEX: &str = "give a vertex 3, 4, 6 or 7 numbers and nothing else";

pub(super) fn parse(file: &str, bytes: &[u8], mut reading: Reading<'_>) -> Result<Mesh, Error> {
    let mut obj = Obj::default();
    for (line, text) in Statements(lines(bytes)) {
        obj.statement(line, &text, &mut reading);
    }
    if obj.beyond || obj.faces.end() > obj.vertices.len() {
        out_of_range(bytes, obj.vertices.len(), &mut reading);
        reading.end()?;
        return Err(Error::bad(file, "a face", "one of its vertices is out of range", FACE));
    }
    if obj.foreign && obj.vertices.len() == 0 && obj.faces.is_empty() {
        let what = "it holds neither vertices nor faces";
        return Err(Error::bad(file, "the file", what, "give an OBJ file of v and f statements"));
    }
    let line = |line: usize| format!("line {line}");
    let mesh = obj.faces.mesh(obj.vertices, line, line, &mut reading);
    reading.end()?;
    Ok(mesh)
}

#[derive(Default)]
struct Obj {
    vertices: Vertices,
    faces: Faces,
    corners: Vec<u32>,
    /// Whether a corner lies before the first vertex.
    beyond: bool,
    /// Whether there is a statement that is not OBJ's.
    foreign: bool,
}

impl Obj {
    fn statement(&mut self, line: usize, text: &[u8], reading: &mut Reading<'_>) {
        let mut words = words(text);
        match words.next() {
            Some(b"v") => self.vertex(words, line, reading),
            Some(b"f" | b"fo") => self.face(words, line, reading),
            Some(word) if OTHER_SURFACE.contains(&word) => {
                let what = format_args!("{} may hold a surface, and is not read", quoted(word));
                reading.fault(
                    format_args!("line {line}"),
                    what,
                    "give every surface as polygons, in v and f statements",
                );
            }
            Some(word) if !NO_SURFACE.contains(&word) => {
                self.foreign = true;
                let place = format_args!("line {line}, {}", quoted(word));
                reading.note(place, "a statement that is not of a polygon mesh is left out");
            }
            _ => {}
        }
    }

    /// `v x y z`, then a weight that only curves have, or a colour, or both.
    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: usize, reading: &mut Reading<'_>) {
        let mut numbers = [Number::default(); 7];
        let mut count = 0;
        for word in words {
            let number = Number::parse(word).unwrap_or_else(|| {
                reading.fault(format_args!("line {line}"), format_args!("{} is not a number", quoted(word)), VERTEX);
                Number::default()
            });
            if let Some(place) = numbers.get_mut(count) {
                *place = number;
            }
            count += 1;
        }
        if !matches!(count, 3 | 4 | 6 | 7) {
            reading.fault(format_args!("line {line}"), format_args!("it is {count} numbers"), VERTEX);
        }
        self.vertices.push([numbers[0], numbers[1], numbers[2]], line, reading);
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: usize, reading: &mut Reading<'_>) {
        self.corners.clear();
        for word in words {
            let Some(number) = corner(word) else {
                let what = format_args!("{} is not the number of a vertex", quoted(word));
                return reading.fault(format_args!("line {line}"), what, FACE);
            };
            match index(number, self.vertices.len()) {
                Some(corner) => self.corners.push(corner),
                None => self.beyond = true,
            }
        }
        if !self.beyond {
            self.faces.push(&self.corners, line);
        }
    }
}

/// The statements, without their comments, by the line that they begin in.
struct Statements<'a>(Lines<'a>);

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let Line { number, text } = self.0.next()?;
        let mut text = Cow::Borrowed(without_comment(text));
        // A `\` at the end of a line goes on in the next; not where names stand, which may be a folder's.
        while let Some(start) = text.trim_ascii_end().strip_suffix(b"\\") {
            let named = words(&text).next().is_none_or(|word| NO_SURFACE.contains(&word));
            if named {
                break;
            }
            let next = self.0.next().map_or(&b""[..], |next| without_comment(next.text));
            text = Cow::Owned([start, b" ", next].concat());
        }
        Some((number, text))
    }
}

fn without_comment(text: &[u8]) -> &[u8] {
    &text[..memchr::memchr(b'#', text).unwrap_or(text.len())]
}

/// The number of a vertex in `v`, `v/vt`, `v//vn` or `v/vt/vn`.
fn corner(word: &[u8]) -> Option<i64> {
    let word = &word[..memchr::memchr(b'/', word).unwrap_or(word.len())];
    let (negative, digits) = match word.split_first()? {
        (b'-', digits) => (true, digits),
        (b'+', digits) => (false, digits),
        _ => (false, word),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut number = 0_i64;
    for &digit in digits {
        let value = digit.wrapping_sub(b'0');
        if value > 9 {
            return None;
        }
        number = number * 10 + i64::from(value);
    }
    Some(if negative { -number } else { number })
}

/// Vertices are numbered from 1 in the file, or back from -1; here from 0.
fn index(number: i64, known: usize) -> Option<u32> {
    let index = if number < 0 { i64::try_from(known).ok()? + number } else { number - 1 };
    u32::try_from(index).ok()
}

/// Adds a fault for each corner that is none of the `total` vertices.
fn out_of_range(bytes: &[u8], total: usize, reading: &mut Reading<'_>) {
    let expected = match total {
        0 => "the file has no vertices: give them in v statements".to_owned(),
        _ => format!("the file has {total} vertices: give 1 to {total}, or from -1 back to the first"),
    };
    let mut known = 0;
    for (line, text) in Statements(lines(bytes)) {
        let mut words = words(&text);
        match words.next() {
            Some(b"v") => known += 1,
            Some(b"f" | b"fo") => {
                for vertex in words.filter_map(corner) {
                    if index(vertex, known).is_none_or(|corner| corner as usize >= total) {
                        let what = format_args!("vertex {vertex} is out of range");
                        reading.fault(format_args!("line {line}"), what, &expected);
                    }
                }
            }
            _ => {}
        }
    }
}
