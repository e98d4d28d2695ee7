//! Meshes with known topology, of about unit size around zero; [`placed`] and [`snapped`] put them elsewhere.
//!
//! Closed ones are wound outward: every edge belongs to two triangles, which run along it in opposite directions.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use rayproof_scene::Mesh;

use super::draw::Draw;

/// The mesh times `size` plus `offset`, each coordinate rounded once.
#[must_use]
pub fn placed(mut mesh: Mesh, size: f64, offset: DVec3) -> Mesh {
    for vertex in &mut mesh.vertices {
        *vertex = (vertex.as_dvec3() * size + offset).as_vec3();
    }
    mesh
}

/// The mesh with each coordinate moved to the nearest multiple of `step`.
#[must_use]
pub fn snapped(mut mesh: Mesh, step: f64) -> Mesh {
    for vertex in &mut mesh.vertices {
        *vertex = ((vertex.as_dvec3() / step).round() * step).as_vec3();
    }
    mesh
}

/// How many directed edges, each counted once, lack the one opposite partner of a closed mesh; 0 where it is closed.
#[must_use]
pub fn open_edges(mesh: &Mesh) -> usize {
    let mut count: HashMap<(u32, u32), usize> = HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            *count.entry(edge).or_default() += 1;
        }
    }
    count.iter().filter(|((a, b), n)| **n != 1 || a == b || count.get(&(*b, *a)) != Some(&1)).count()
}

/// A closed sphere of radius 1 with `around` meridians and `rings` bands: `2 around (rings - 1)` triangles.
#[must_use]
pub fn uv_sphere(around: u32, rings: u32) -> Mesh {
    rough_sphere(around, rings, || 1.0)
}

/// The closed sphere of pbrt's watertight test: each vertex at its own radius from 1 to 6, drawn from the seed.
#[must_use]
pub fn bumpy_sphere(around: u32, rings: u32, seed: u64) -> Mesh {
    let mut draw = Draw::new(seed, 0, 0);
    rough_sphere(around, rings, || draw.range(1.0, 6.0))
}

fn rough_sphere(around: u32, rings: u32, mut radius: impl FnMut() -> f64) -> Mesh {
    let mut vertices = vec![(DVec3::Z * radius()).as_vec3()];
    for ring in 1..rings {
        let (sin, cos) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
        for i in 0..around {
            let (y, x) = (TAU * f64::from(i) / f64::from(around)).sin_cos();
            vertices.push((DVec3::new(sin * x, sin * y, cos) * radius()).as_vec3());
        }
    }
    vertices.push((DVec3::NEG_Z * radius()).as_vec3());
    let last = around * (rings - 1) + 1;
    let at = |ring: u32, i: u32| 1 + (ring - 1) * around + i % around;
    let mut triangles = Vec::new();
    for i in 0..around {
        triangles.push([0, at(1, i), at(1, i + 1)]);
        for ring in 1..rings - 1 {
            triangles.push([at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)]);
            triangles.push([at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)]);
        }
        triangles.push([last, at(rings - 1, i + 1), at(rings - 1, i)]);
    }
    Mesh { vertices, triangles }
}

/// A closed sphere of radius 1: an icosahedron, each triangle split in four `level` times.
#[must_use]
pub fn icosphere(level: u32) -> Mesh {
    let g = (1.0 + 5_f64.sqrt()) / 2.0;
    let mut vertices = Vec::new();
    for (a, b) in [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)] {
        vertices.extend([DVec3::new(a, b, 0.0), DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a)]);
    }
    let mut vertices: Vec<DVec3> = vertices.into_iter().map(DVec3::normalize).collect();
    let mut triangles = hull(&vertices);
    for _ in 0..level {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
                index(vertices.len() - 1)
            })
        };
        let split = |[a, b, c]: [u32; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    Mesh { vertices: vertices.into_iter().map(|v| v.as_vec3()).collect(), triangles }
}

/// The icosahedron's faces: every three of its vertices that are an edge apart, wound outward.
fn hull(vertices: &[DVec3]) -> Vec<[u32; 3]> {
    let near = |a: DVec3, b: DVec3| a.distance(b) < 1.1;
    let mut faces = Vec::new();
    for (i, &a) in vertices.iter().enumerate() {
        for (j, &b) in vertices.iter().enumerate().skip(i + 1) {
            for (k, &c) in vertices.iter().enumerate().skip(j + 1) {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = (b - a).cross(c - a).dot(a) > 0.0;
                    let (j, k) = if outward { (j, k) } else { (k, j) };
                    faces.push([index(i), index(j), index(k)]);
                }
            }
        }
    }
    faces
}

/// The closed box from -1 to 1, each face a grid of `n` x `n` squares of two triangles.
#[must_use]
pub fn cube(n: u32) -> Mesh {
    let mut seen: HashMap<[u32; 3], u32> = HashMap::new();
    let mut mesh = Mesh::default();
    for axis in 0..3_usize {
        for side in [0, n] {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                    let mut at = [0; 3];
                    (at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3]) = (side, i, j);
                    *seen.entry(at).or_insert_with(|| {
                        let p = DVec3::from_array(at.map(|x| 2.0 * f64::from(x) / f64::from(n) - 1.0));
                        mesh.vertices.push(p.as_vec3());
                        index(mesh.vertices.len() - 1)
                    })
                });
                let [a, b, c, d] = if side == n { corners } else { [corners[1], corners[0], corners[3], corners[2]] };
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    mesh
}

/// A closed torus around z: centre line of radius 1, tube of radius `tube`, `around` x `across` quads.
#[must_use]
pub fn torus(around: u32, across: u32, tube: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    for i in 0..around {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(around)).sin_cos();
        for j in 0..across {
            let (z, out) = (TAU * f64::from(j) / f64::from(across)).sin_cos();
            let r = 1.0 + tube * out;
            mesh.vertices.push(DVec3::new(r * cos, r * sin, tube * z).as_vec3());
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// A closed double fan: two tips of valence `k` at z = 1/2 and -1/2 over a rim of radius 1.
#[must_use]
pub fn double_fan(k: u32) -> Mesh {
    let mut mesh = fan(k, 0.5);
    mesh.vertices.push(Vec3::new(0.0, 0.0, -0.5));
    mesh.triangles.extend((0..k).map(|i| [k + 1, 1 + (i + 1) % k, 1 + i]));
    mesh
}

/// An open fan: vertex 0 of valence `k` at z = `height`, over a rim of radius 1 at z = 0.
#[must_use]
pub fn fan(k: u32, height: f64) -> Mesh {
    let mut vertices = vec![DVec3::new(0.0, 0.0, height).as_vec3()];
    for i in 0..k {
        let (y, x) = (TAU * f64::from(i) / f64::from(k)).sin_cos();
        vertices.push(DVec3::new(x, y, 0.0).as_vec3());
    }
    Mesh { vertices, triangles: (0..k).map(|i| [0, 1 + i, 1 + (i + 1) % k]).collect() }
}

/// An open flat grid in the plane z = 0, from 0 to `n` in x and y in steps of 1: `2 n n` triangles.
#[must_use]
pub fn grid(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
        mesh.vertices.push(DVec3::new(f64::from(i), f64::from(j), 0.0).as_vec3());
        if i < n && j < n {
            let a = i * (n + 1) + j;
            let (b, c, d) = (a + n + 1, a + n + 2, a + 1);
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// A position in a mesh's vertices as the mesh stores it; these meshes are far below 2^32 vertices.
fn index(i: usize) -> u32 {
    u32::try_from(i).expect("meshes of families are small")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume that the winding encloses: positive where it runs outward.
    fn volume(mesh: &Mesh) -> f64 {
        (0..mesh.triangles.len())
            .map(|i| mesh.triangle(i))
            .map(|t| t.a.as_dvec3().dot(t.b.as_dvec3().cross(t.c.as_dvec3())))
            .sum()
    }

    #[test]
    fn closed_meshes_are_closed_and_wound_outward() {
        let closed = [
            ("uv sphere", uv_sphere(5, 3), 20),
            ("uv sphere", uv_sphere(40, 20), 1520),
            ("bumpy sphere", bumpy_sphere(16, 16, 12111), 480),
            ("icosahedron", icosphere(0), 20),
            ("icosphere", icosphere(2), 320),
            ("box", cube(1), 12),
            ("box of squares", cube(3), 108),
            ("torus", torus(12, 7, 0.3), 168),
            ("double fan", double_fan(3), 6),
            ("double fan", double_fan(1000), 2000),
            ("whole numbers", snapped(placed(double_fan(1000), 1000.0, DVec3::splat(3.0)), 1.0), 2000),
        ];
        for (name, mesh, triangles) in closed {
            assert_eq!(mesh.triangles.len(), triangles, "{name}");
            assert_eq!(open_edges(&mesh), 0, "{name} of {triangles}");
            assert!(volume(&mesh) > 0.0, "{name} of {triangles}");
            let mut bits: Vec<_> = mesh.vertices.iter().map(|v| v.to_array().map(f32::to_bits)).collect();
            bits.sort_unstable();
            bits.dedup();
            assert_eq!(bits.len(), mesh.vertices.len(), "{name} of {triangles}: two vertices in one place");
        }
    }

    #[test]
    fn open_edges_are_found() {
        assert_eq!(open_edges(&fan(6, 0.5)), 6);
        assert_eq!(open_edges(&grid(3)), 12);
        let mut damaged = cube(1);
        damaged.triangles[3].swap(0, 1);
        assert_eq!(open_edges(&damaged), 3, "a triangle wound the wrong way: its edges run twice in one direction");
    }

    #[test]
    fn placing_rounds_once_and_snapping_lands_on_the_grid() {
        let mesh = placed(grid(2), 0.25, DVec3::new(1e5, 0.0, -3.0));
        assert_eq!(mesh.vertices[4], Vec3::new(100_000.25, 0.25, -3.0));
        let mesh = snapped(placed(uv_sphere(7, 5), 1000.0, DVec3::ZERO), 8.0);
        assert!(mesh.vertices.iter().all(|v| *v % 8.0 == Vec3::ZERO));
    }
}
