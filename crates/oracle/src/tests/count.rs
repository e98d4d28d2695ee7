//! Crossings of closed meshes, aimed where the tie rule decides.

use glam::Vec3;
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Sphere};

use super::{Random, sphere_scene};
use crate::Oracle;

/// A closed mesh with integer vertices, star-shaped around the origin: an octahedron, each face in 16, with bumps.
fn star() -> Mesh {
    let axes = [1.0, -1.0];
    let mut mesh = Mesh::default();
    let mut index = |p: Vec3| {
        // Integer weights give integer points; the bumps scale them by 3, 4 or 5.
        let bump = 3.0 + (p.x + 2.0 * p.y + 3.0 * p.z).rem_euclid(3.0);
        let p = p * bump;
        mesh.vertices.iter().position(|&q| q == p).unwrap_or_else(|| {
            mesh.vertices.push(p);
            mesh.vertices.len() - 1
        })
    };
    let mut triangles = vec![];
    for [x, y, z] in axes.into_iter().flat_map(|x| axes.into_iter().flat_map(move |y| axes.map(|z| [x, y, z]))) {
        let n = 4_u8;
        let mut at = |i: u8, j: u8| index(Vec3::new(x * f32::from(n - i - j), y * f32::from(i), z * f32::from(j)));
        for i in 0..n {
            for j in 0..n - i {
                triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 2 <= n {
                    triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
    }
    mesh.triangles = triangles.into_iter().map(|t| t.map(|i| u32::try_from(i).unwrap())).collect();
    mesh
}

/// The cube from -1 to 1, two triangles a face.
fn cube() -> Mesh {
    let vertices = (0..8_u8).map(|i| Vec3::from_array([0, 1, 2].map(|k| f32::from(i >> k & 1) * 2.0 - 1.0))).collect();
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    Mesh { vertices, triangles: quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect() }
}

/// Every vertex, and sums of the ends of every edge and of the corners of every face: exact directions from 0.
fn targets(mesh: &Mesh) -> Vec<Vec3> {
    let corners = (0..mesh.triangles.len()).map(|i| mesh.triangle(i));
    corners.flat_map(|t| [t.a, t.a + t.b, t.b + t.c, t.a + t.c, t.a + t.b + t.c]).collect()
}

fn scene(mesh: &Mesh) -> Scene {
    Scene::new(vec![Geometry::Mesh(mesh.clone())]).expect("a valid scene")
}

#[test]
fn from_the_centre_everything_is_crossed_once() {
    for mesh in [star(), cube()] {
        let scene = scene(&mesh);
        let (oracle, mut shared) = (Oracle::new(&scene), 0);
        for d in targets(&mesh) {
            let ray = Ray::new(Vec3::ZERO, d);
            assert_eq!(oracle.count(&ray), 1, "{d}");
            shared += usize::from(oracle.all(&ray).len() > 1);
        }
        println!("{} triangles: {shared} of {} rays meet more than one", mesh.triangles.len(), targets(&mesh).len());
        assert!(2 * shared > targets(&mesh).len());
    }
}

/// From any point off the surface the parity is that of inside or outside, whatever the direction; a whole line
/// crosses an even number of times.
#[test]
fn parity_tells_inside_from_outside() {
    let mut random = Random::new(0x5eed_0010);
    let (mut silhouettes, mut inside) = (0, 0);
    for (mesh, reach) in [(star(), 20), (cube(), 3)] {
        let scene = scene(&mesh);
        let oracle = Oracle::new(&scene);
        for _ in 0..60 {
            let e = random.lattice(reach);
            let on_surface = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(1.0, 3.0, 7.0)];
            if on_surface.iter().any(|&d| oracle.any(&Ray { t_max: 0.0, ..Ray::new(e, d) })) {
                continue;
            }
            // An irrational-looking direction meets no edge: it settles the matter by plain parity.
            let free = Ray::new(e, Vec3::new(0.577_215_7, 0.314_159_27, 0.271_828_2));
            let parity = u32::try_from(oracle.all(&free).len() % 2).unwrap();
            inside += parity;
            let aims = targets(&mesh);
            let picked = (0..40).map(|_| aims[random.below(u32::try_from(aims.len()).unwrap()) as usize]);
            for target in picked.chain([e + Vec3::X, e - Vec3::Y, e + Vec3::Z, e + Vec3::ONE]).filter(|&p| p != e) {
                let ray = Ray::new(e, target - e);
                let count = oracle.count(&ray);
                assert_eq!(count % 2, parity, "{ray:?}");
                assert_eq!(oracle.count(&Ray { t_min: f32::NEG_INFINITY, ..ray }) % 2, 0, "{ray:?}");
                silhouettes += usize::from(count == 0 && oracle.any(&ray));
            }
        }
    }
    println!("{inside} origins inside; {silhouettes} rays touch the surface without crossing it");
    assert!(inside > 5 && silhouettes > 5);
}

#[test]
fn along_an_edge_and_in_a_face_of_a_cube() {
    let scene = scene(&cube());
    let oracle = Oracle::new(&scene);
    for ray in [
        Ray::new(Vec3::new(-3.0, 1.0, 1.0), Vec3::X),
        Ray::new(Vec3::new(-3.0, 1.0, 0.5), Vec3::X),
        Ray::new(Vec3::new(-3.0, -1.0, -1.0), Vec3::new(1.0, 0.5, 0.5)),
        Ray::new(Vec3::new(-3.0, -1.0, 1.0), Vec3::X),
        Ray::new(Vec3::new(-2.0, 0.0, 1.0), Vec3::new(1.0, 1.0, 0.0)),
    ] {
        assert!([0, 2].contains(&oracle.count(&ray)), "{ray:?}: {}", oracle.count(&ray));
    }
}

/// The rule itself, on an open triangle: the line moves along the axis after the largest of `d`, and less along the
/// next. In the plane of those two axes the triangle is (0, 0), (2, 0), (2, 2).
#[test]
fn the_tie_rule_is_the_documented_one() {
    for axis in 0..3 {
        let place = |x: f32, y: f32, z: f32| {
            let mut p = [0.0; 3];
            (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (z, x, y);
            Vec3::from_array(p)
        };
        let corners = [place(0.0, 0.0, 0.0), place(2.0, 0.0, 0.0), place(2.0, 2.0, 0.0)];
        let scene = scene(&Mesh { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] });
        // Of equal components the first is the largest: x before y before z.
        let tie = [place(1.0, -1.0, 1.0), place(1.0, 0.5, 1.0), place(0.5, 0.5, 1.0)][axis];
        for d in [place(0.0, 0.0, -1.0), place(0.5, 0.25, 1.0), tie] {
            let expected = [(0.0, 0.0, 1), (2.0, 0.0, 0), (2.0, 2.0, 0), (1.0, 0.0, 1), (1.0, 1.0, 1), (2.0, 1.0, 0)];
            for (x, y, count) in expected {
                let ray = Ray::new(place(x, y, 0.0) - d * 4.0, d);
                assert_eq!(Oracle::new(&scene).all(&ray).len(), 1, "{ray:?}");
                assert_eq!(Oracle::new(&scene).count(&ray), count, "{ray:?}");
            }
        }
    }
}

#[test]
fn a_tangent_of_a_sphere_counts_twice_and_the_range_cuts() {
    let scene = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 5.0 }]);
    let oracle = Oracle::new(&scene);
    let tangent = Ray::new(Vec3::new(-2.0, 5.0, 0.0), Vec3::X);
    assert_eq!(oracle.count(&tangent), 2);
    assert_eq!(oracle.count(&Ray { t_max: 2.0_f32.next_down(), ..tangent }), 0);
    let through = Ray::new(Vec3::new(-10.0, 4.0, 0.0), Vec3::X);
    assert_eq!(oracle.count(&through), 2);
    assert_eq!(oracle.count(&Ray { t_min: 7.0, t_max: 12.0, ..through }), 1);
    assert_eq!(oracle.count(&Ray { t_min: 7.0, t_max: 13.0, ..through }), 2);
}
