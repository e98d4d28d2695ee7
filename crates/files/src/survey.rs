//! What a geometry is made of, before any ray is asked: is it closed, and what is odd about it?

use std::collections::HashMap;

use glam::{DVec3, Vec3};
use serde::Serialize;

use crate::scenes::is_flat;
use rayproof_scene::{Geometry, Mesh};

/// So many of a kind, and which triangle is the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// How many there are.
    pub count: usize,
    /// The first triangle that is one, or has one.
    pub first: Option<usize>,
}

impl Tally {
    fn add(&mut self, triangle: usize) {
        self.count += 1;
        self.first = Some(self.first.map_or(triangle, |first| first.min(triangle)));
    }
}

/// What is odd about a geometry. Vertices are one where they are at one place, whatever their numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Survey {
    /// Edges of one triangle only.
    pub boundary_edges: Tally,
    /// Edges of more than two triangles.
    pub non_manifold_edges: Tally,
    /// Triangles whose three corners are another's before them, in any order.
    pub duplicate_triangles: Tally,
    /// Triangles without area, which no ray hits.
    pub flat_triangles: Tally,
    /// Edges of an odd number of triangles: what a surface that is closed has none of.
    pub open_edges: Tally,
}

impl Survey {
    /// Looks a geometry over: some 100 ns and 60 bytes a triangle.
    #[must_use]
    pub fn of(geometry: &Geometry) -> Self {
        match geometry {
            Geometry::Mesh(mesh) => Self::of_mesh(mesh),
            Geometry::Spheres(_) => Self::default(),
        }
    }

    /// Whether the surface has no rim, so that a ray from inside leaves it an odd number of times. Spheres are closed.
    #[must_use]
    pub const fn is_closed(&self) -> bool {
        self.open_edges.count == 0
    }

    fn of_mesh(mesh: &Mesh) -> Self {
        let places = places(&mesh.vertices);
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| places[corner as usize]);
        let mut survey = Self::default();
        let (mut edges, mut seen) = (Vec::with_capacity(mesh.triangles.len() * 3), Vec::new());
        for (i, triangle) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = corners(triangle);
            // An edge from a place to itself is none; the other two of such a triangle are one edge, there and back.
            edges.extend(
                [[a, b], [b, c], [c, a]].into_iter().filter(|[a, b]| a != b).map(|[a, b]| (a.min(b), a.max(b), i)),
            );
            let mut sorted = [a, b, c];
            sorted.sort_unstable();
            seen.push((sorted, i));
            let exact = |corner: u32| -> DVec3 { mesh.vertices[corner as usize].as_dvec3() };
            if is_flat(triangle.map(exact)) {
                survey.flat_triangles.add(i);
            }
        }
        edges.sort_unstable();
        for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let first = same[0].2;
            match same.len() {
                1 => survey.boundary_edges.add(first),
                2 => {}
                _ => survey.non_manifold_edges.add(first),
            }
            if !same.len().is_multiple_of(2) {
                survey.open_edges.add(first);
            }
        }
        seen.sort_unstable();
        for same in seen.chunk_by(|a, b| a.0 == b.0) {
            same[1..].iter().for_each(|&(_, i)| survey.duplicate_triangles.add(i));
        }
        survey
    }
}

/// For each vertex the first that is at its place.
fn places(vertices: &[Vec3]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(vertices.len());
    // 0 and -0 are one place.
    let key = |v: &Vec3| (*v + 0.0).to_array().map(f32::to_bits);
    (0..).zip(vertices).map(|(i, v)| *first.entry(key(v)).or_insert(i)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tally(count: usize, first: usize) -> Tally {
        Tally { count, first: Some(first) }
    }

    const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const SHELL: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    #[test]
    fn a_shell_is_closed_until_a_triangle_is_gone() {
        let survey = |triangles: &[[u32; 3]]| Survey::of(&Geometry::Mesh(Mesh::new(CORNERS, triangles.to_vec())));
        assert_eq!(survey(&SHELL), Survey::default());
        let open = survey(&SHELL[..3]);
        assert_eq!((open.is_closed(), open.boundary_edges, open.open_edges), (false, tally(3, 0), tally(3, 0)));
        // Twice is a surface that a ray crosses an even number of times, and closed.
        let twice = survey(&[&SHELL[..], &SHELL].concat());
        assert_eq!(
            (twice.is_closed(), twice.duplicate_triangles, twice.non_manifold_edges),
            (true, tally(4, 4), tally(6, 0))
        );
        let one_more = survey(&[&SHELL[..], &[[3, 1, 2]]].concat());
        assert_eq!(
            (one_more.is_closed(), one_more.duplicate_triangles, one_more.open_edges),
            (false, tally(1, 4), tally(3, 0))
        );
        assert_eq!(survey(&[]), Survey::default());
    }

    #[test]
    fn vertices_are_places_and_flat_triangles_close_what_they_join() {
        let apart: Vec<[f32; 3]> = SHELL.as_flattened().iter().map(|&i| CORNERS[i as usize].map(|x| -x)).collect();
        let own = (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        assert_eq!(Survey::of(&Geometry::Mesh(Mesh::new(apart, own))), Survey::default());
        // The edge from 0 to 1 has a corner at its middle on one side only; a triangle without area joins the two.
        let mut corners = CORNERS.to_vec();
        corners.push([0.5, 0.0, 0.0]);
        let split = vec![[0, 2, 1], [0, 4, 3], [4, 1, 3], [0, 3, 2], [1, 2, 3]];
        let open = Survey::of(&Geometry::Mesh(Mesh::new(corners.clone(), split.clone())));
        assert_eq!((open.is_closed(), open.boundary_edges.count), (false, 3));
        let joined = Survey::of(&Geometry::Mesh(Mesh::new(corners, [&split[..], &[[0, 1, 4], [2, 2, 0]]].concat())));
        assert_eq!((joined.is_closed(), joined.flat_triangles, joined.boundary_edges.count), (true, tally(2, 5), 0));
        assert!(Survey::of(&Geometry::Spheres(vec![])).is_closed());
    }
}
