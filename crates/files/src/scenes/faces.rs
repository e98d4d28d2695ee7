//! The faces of a mesh file, in its order, and the triangles that they become.

use std::fmt::Display;

use super::polygon::{Inside, Polygons};
use super::reading::{Reading, Vertices};
use rayproof_scene::Mesh;

/// Faces of any number of corners. One of n corners has n - 2 triangles, which are found once all vertices are known: a face may
/// come before its vertices.
#[derive(Default)]
pub(super) struct Faces {
    triangles: Vec<[u32; 3]>,
    /// Faces of more than three corners, whose triangles are still to be found.
    polygons: Vec<Polygon>,
    /// Their corners, one after the other.
    corners: Vec<u32>,
    highest: Option<u32>,
    /// Those of fewer than three: which numbers their places are told by.
    few: Vec<usize>,
}

struct Polygon {
    /// What its place is told by.
    number: usize,
    /// The first of its triangles.
    triangle: usize,
    corners: usize,
}

impl Faces {
    pub(super) fn with_capacity(count: usize) -> Self {
        Self { triangles: Vec::with_capacity(count), ..Self::default() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// One more than the highest number of a vertex.
    pub(super) fn end(&self) -> usize {
        self.highest.map_or(0, |highest| highest as usize + 1)
    }

    /// Adds a face; `number` is for the words that say where it stands.
    pub(super) fn push(&mut self, corners: &[u32], number: usize) {
        self.highest = self.highest.max(corners.iter().copied().max());
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [_, _, _, ..] => {
                self.polygons.push(Polygon { number, triangle: self.triangles.len(), corners: corners.len() });
                self.corners.extend(corners);
                self.triangles.extend(std::iter::repeat_n([0; 3], corners.len() - 2));
            }
            _ => self.few.push(number),
        }
    }

    /// Adds the triangles of a strip: every three corners in a row, the second, fourth, .. of them turned around.
    pub(super) fn push_strip(&mut self, corners: &[u32]) {
        self.highest = self.highest.max(corners.iter().copied().max());
        let turned = |(i, corners): (usize, &[u32])| match i % 2 {
            0 => [corners[0], corners[1], corners[2]],
            _ => [corners[1], corners[0], corners[2]],
        };
        self.triangles.extend(corners.windows(3).enumerate().map(turned));
    }

    /// The mesh of these faces; the highest number of a vertex is below [`end`](Self::end). `place` says by their numbers where
    /// a face stands, and `vertex_place` where a vertex does.
    pub(super) fn mesh<F: Display, V: Display>(
        mut self,
        vertices: Vertices,
        place: impl Fn(usize) -> F,
        vertex_place: impl Fn(usize) -> V,
        reading: &mut Reading<'_>,
    ) -> Mesh {
        for number in self.few {
            reading.note(format_args!("{}", place(number)), "a face of fewer than three corners is left out");
        }
        let (mut polygons, mut ears) = (Polygons::default(), Vec::new());
        let mut rest = &self.corners[..];
        for &Polygon { number, triangle, corners } in &self.polygons {
            let (these, others) = rest.split_at(corners);
            rest = others;
            ears.clear();
            if polygons.triangulate(these, vertices.rounded(), &mut ears) == Inside::Crossed {
                let what = "a polygon that crosses itself is fanned from its first corner";
                reading.note(format_args!("{}", place(number)), what);
            }
            self.triangles[triangle..][..ears.len()].copy_from_slice(&ears);
        }
        vertices.mesh(self.triangles, vertex_place, reading)
    }
}
