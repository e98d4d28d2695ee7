//! Wavefront OBJ: the `v` and `f` statements of the format's specification, version 3.0.
//!
//! Read here and not by tobj, which drops vertices that no face uses (and with them their NaN), hashes every corner,
//! and reports neither the line of a fault nor how many there are. The tests compare the two.

use glam::Vec3;

use super::faults::Faults;
use crate::Error;
use rayproof_scene::Mesh;

/// Statements that hold no triangle.
const NO_SURFACE: [&str; 19] = [
    "vt",
    "vn",
    "vp",
    "p",
    "l",
    "o",
    "g",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
];

pub(super) fn parse(file: &str, bytes: &[u8]) -> Result<Mesh, Error> {
    let mut faults = Faults::new(file);
    // Counted first, because a face may name a vertex that comes after it.
    let total = statements(bytes).filter(|(_, text)| text.split_ascii_whitespace().next() == Some("v")).count();
    let mut mesh = Mesh { vertices: Vec::with_capacity(total), triangles: Vec::new() };
    let mut corners = Vec::new();
    for (line, text) in statements(bytes) {
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => mesh.vertices.push(vertex(words, line, &mut faults)),
            Some("f") => {
                corners.clear();
                let known = mesh.vertices.len();
                let whole = words.try_for_each(|word| {
                    corners.push(corner(word, known, total, line, &mut faults)?);
                    Some(())
                });
                if whole.is_some() && corners.len() < 3 {
                    let what = format_args!("`{}` is not a face", text.trim());
                    faults.add(format_args!("line {line}"), what, "give a face three vertices or more");
                }
                mesh.triangles.extend(fan(&corners));
            }
            Some(word) if word.starts_with('#') || NO_SURFACE.contains(&word) => {}
            Some(word) => faults.add(
                format_args!("line {line}"),
                format_args!("`{word}` is not a statement of a polygon mesh"),
                "give an OBJ file of v and f statements",
            ),
            None => {}
        }
    }
    faults.none()?;
    Ok(mesh)
}

/// The triangles of a polygon: from its first vertex, in order.
pub(super) fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let first = corners.first().copied().unwrap_or_default();
    corners.windows(2).skip(1).map(move |edge| [first, edge[0], edge[1]])
}

/// The lines, counting from 1. Names and comments need not be UTF-8.
fn statements(bytes: &[u8]) -> impl Iterator<Item = (usize, std::borrow::Cow<'_, str>)> {
    (1..).zip(bytes.split(|&b| b == b'\n').map(String::from_utf8_lossy))
}

/// `x y z` and whatever follows: a weight for curves, or a colour.
fn vertex<'a>(mut words: impl Iterator<Item = &'a str>, line: usize, faults: &mut Faults<'_>) -> Vec3 {
    let mut v = Vec3::ZERO;
    for axis in v.as_mut() {
        let word = words.next().unwrap_or("nothing");
        *axis = word.parse().unwrap_or_else(|_| {
            let what = format_args!("`{word}` is not a number");
            faults.add(format_args!("line {line}"), what, "give a vertex three numbers");
            0.0
        });
    }
    faults.vertex(format_args!("line {line}"), v);
    v
}

/// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counting from 0; in the file from 1, or back from -1.
fn corner(word: &str, known: usize, total: usize, line: usize, faults: &mut Faults<'_>) -> Option<u32> {
    let place = format_args!("line {line}");
    let Ok(number) = word.split('/').next().unwrap_or_default().parse::<i64>() else {
        faults.add(
            place,
            format_args!("`{word}` is not the number of a vertex"),
            "give a face as v, v/vt, v//vn or v/vt/vn",
        );
        return None;
    };
    let index = if number < 0 { i64::try_from(known).ok()?.checked_add(number) } else { number.checked_sub(1) };
    match index.and_then(|i| u32::try_from(i).ok()).filter(|&i| (i as usize) < total) {
        Some(index) => Some(index),
        None => {
            let what = format_args!("vertex {number} is out of range");
            let expected = format!("the file has {total} vertices: give 1 to {total}, or from -1 back to the first");
            faults.add(place, what, &expected);
            None
        }
    }
}
