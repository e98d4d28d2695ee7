//! Family 41: scenes and rays that failed in the field, by their published numbers, then their closest neighbours.
//!
//! Each case starts with the recorded rays, bit for bit; the rest of the batch moves their slots by a few ulps.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Sphere, Triangle};

use super::Case;
use super::aim::{along, soup, toward, ulps, within};
use super::draw::Draw;
use super::meshes::{bumpy_sphere, cube, grid, placed, uv_sphere};

/// How many recorded cases there are.
pub(super) const RECORDED: usize = 13;

/// 41: one recorded case, its rays first, then neighbours of them.
pub(super) fn recorded(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (geometry, known) = match variant {
        0 => pbrt_sliver(),
        1 => embree_coplanar(),
        2 => embree_on_surface(),
        3 => embree_spheres(),
        4 => trimesh_on_vertex(),
        5 => open3d_occupancy(),
        6 => pbrt_watertight(draw),
        7 => tinybvh_small(),
        8 => diagonal_seam(),
        9 => trimesh_between_triangles(),
        10 => trimesh_nested_boxes(),
        11 => embree_small_triangles(),
        _ => embree_skinny(draw),
    };
    // A shorter batch than the record starts anywhere in it, so that every ray has its turn.
    let first = if rays < known.len() { draw.below(known.len()) } else { 0 };
    let mut all: Vec<Ray> = known.iter().cycle().skip(first).take(known.len().min(rays)).copied().collect();
    all.extend((all.len()..rays).map(|_| nudged(draw, &known)));
    Case { scene: Scene::new(vec![geometry]).expect("made of finite numbers"), rays: all }
}

/// A recorded ray with up to six slots moved by up to two ulps.
fn nudged(draw: &mut Draw, known: &[Ray]) -> Ray {
    let mut ray = draw.pick(known);
    let slots = draw.pick(&[1, 1, 6]);
    for _ in 0..slots {
        let (axis, n) = (draw.below(3), draw.pick(&[-2, -1, 1, 2]));
        let part = if draw.chance(0.5) { &mut ray.origin[axis] } else { &mut ray.direction[axis] };
        *part = ulps(*part, n);
    }
    ray
}

fn triangle(corners: [[f32; 3]; 3]) -> Geometry {
    let [a, b, c] = corners.map(Vec3::from);
    Geometry::Mesh(soup(&[Triangle { a, b, c }]))
}

fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray::new(origin, direction)
}

/// pbrt-v4, shapes_test.cpp, Triangle.BadCases: three vertices on one line; no hit.
fn pbrt_sliver() -> (Geometry, Vec<Ray>) {
    let [x, z] = [-1_113.454_6, -56.243_19];
    let corners = [-79.049_614, -87.092_27, -79.209_015].map(|y| [x, y, z]);
    let hit = ray([-1_081.479_2, 99.999_954, 87.770_11], [-32.1073, -183.355_87, -144.607_64]);
    (triangle(corners), vec![within(hit, 0.0, 0.9999), hit])
}

/// The right triangle of Embree's issues 133 and 298.
const CORNER: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Embree issue 298: a ray in the triangle's plane, through its inside; a miss by the contract.
fn embree_coplanar() -> (Geometry, Vec<Ray>) {
    let rays = vec![ray([-1.0, 0.5, 0.0], [1.0, 0.0, 0.0]), ray([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0])];
    (triangle(CORNER), rays)
}

/// Embree issue 133: origins on the triangle's surface.
fn embree_on_surface() -> (Geometry, Vec<Ray>) {
    let mut rays = Vec::new();
    for origin in [[0.25, 0.25, 0.0], [0.5, 0.5, 0.0], [0.0, 0.0, 0.0], [0.5, 0.0, 0.0]] {
        for z in [-1.0, 1.0] {
            rays.extend([ray(origin, [0.0, 0.0, z]), ray(origin, [0.3, -0.2, z])]);
        }
    }
    (triangle(CORNER), rays)
}

/// Embree, sphere_intersector_tests.cpp, case 676: two overlapping spheres, sphere 0 at t = 10.2983.
fn embree_spheres() -> (Geometry, Vec<Ray>) {
    let spheres = [[9.668_709, -16.396_57, 3.939_959_3], [10.044_188, -9.693_453, 3.948_930_7]];
    let spheres = spheres.map(|center| Sphere { center: center.into(), radius: 9.0 });
    let hit = ray([14.800_113, -9.017_685, 3.470_127_6], [-0.989_340_25, -0.019_010_112, -0.144_376_26]);
    (Geometry::Spheres(spheres.to_vec()), vec![hit, within(hit, 1e-5, f32::INFINITY)])
}

/// trimesh, tests/test_ray.py, on_vertex and on_edge: from the centre of a unit box, exactly one hit each.
fn trimesh_on_vertex() -> (Geometry, Vec<Ray>) {
    let mesh = placed(cube(1), 0.5, DVec3::ZERO);
    let steps = [-0.5_f32, 0.0, 0.5];
    let mut rays = Vec::new();
    for [x, y, z] in triples(&steps) {
        if [x, y, z] != [0.0; 3] {
            rays.push(ray([0.0; 3], [x, y, z]));
        }
    }
    (Geometry::Mesh(mesh), rays)
}

/// Open3D, test_raycasting_scene.py, sphere_wrong_occupancy: 6^3 points around a sphere of radius 0.8, along x, y, z.
///
/// The points are inside where the count is odd. By that test's table those with `i, j` (of y and x) in 1..=4 are
/// inside for all four middle z but for the corners of the 4 x 4 x 4 block.
fn open3d_occupancy() -> (Geometry, Vec<Ray>) {
    let mesh = placed(uv_sphere(40, 20), 0.8, DVec3::ZERO);
    let at = [0, 1, 2, 3, 4, 5].map(|i| -0.88 + 1.76 * f64::from(i) / 5.0);
    let mut rays = Vec::new();
    for [x, y, z] in triples(&at) {
        let origin = DVec3::new(x, y, z).as_vec3();
        rays.extend([DVec3::X, DVec3::Y, DVec3::Z].map(|d| along(origin, d)));
    }
    (Geometry::Mesh(mesh), rays)
}

/// Every three of these values, in order.
fn triples<T: Copy>(of: &[T]) -> impl Iterator<Item = [T; 3]> {
    of.iter().flat_map(move |&x| of.iter().flat_map(move |&y| of.iter().map(move |&z| [x, y, z])))
}

/// pbrt-v4, shapes_test.cpp, Triangle.Watertight (disabled there): from inside a bumpy sphere to each vertex.
///
/// Their construction and seed, with our own generator: not its very numbers.
fn pbrt_watertight(draw: &mut Draw) -> (Geometry, Vec<Ray>) {
    let mesh = bumpy_sphere(16, 16, 12111);
    let aim = |v: &Vec3| {
        let origin = (draw.unit() * 0.5 * draw.range(0.0, 1.0).cbrt()).as_vec3();
        Ray::new(origin, *v - origin)
    };
    let rays = mesh.vertices.iter().map(aim).collect();
    (Geometry::Mesh(mesh), rays)
}

/// tinybvh, tiny_bvh.h: triangles of size 1e-4, all missed by a determinant test against 1e-6; unit directions.
fn tinybvh_small() -> (Geometry, Vec<Ray>) {
    let mesh = placed(grid(4), 1e-4, DVec3::ZERO);
    let rays = centroids(&mesh).map(|p| along((p + DVec3::Z).as_vec3(), DVec3::NEG_Z)).collect();
    (Geometry::Mesh(mesh), rays)
}

fn centroids(mesh: &Mesh) -> impl Iterator<Item = DVec3> {
    let all = (0..mesh.triangles.len()).map(|i| mesh.triangle(i));
    all.map(|t| (t.a.as_dvec3() + t.b.as_dvec3() + t.c.as_dvec3()) / 3.0)
}

/// Oblikovati issue 2146: a hairline crack at the diagonal of a square, at (3.375, 3.375, 0).
fn diagonal_seam() -> (Geometry, Vec<Ray>) {
    let vertices = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let mesh = Mesh { vertices: vertices.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] };
    (Geometry::Mesh(mesh), vec![ray([0.0, 0.0, 10.0], [0.304_584_47, 0.304_584_47, -0.902_472_5])])
}

/// trimesh issue 1766: straight down on the diagonal between two triangles.
fn trimesh_between_triangles() -> (Geometry, Vec<Ray>) {
    let vertices = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let mesh = Mesh { vertices: vertices.to_vec(), triangles: vec![[0, 1, 2], [2, 3, 0]] };
    (Geometry::Mesh(mesh), vec![ray([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])])
}

/// trimesh issue 1496: from the centre of a box of 40, cut in squares, to the vertices of a box of 60 cut in thirds.
fn trimesh_nested_boxes() -> (Geometry, Vec<Ray>) {
    let outer = placed(cube(4), 30.0, DVec3::ZERO);
    let rays = outer.vertices.iter().map(|v| Ray::new(Vec3::ZERO, *v)).collect();
    (Geometry::Mesh(placed(cube(2), 20.0, DVec3::ZERO)), rays)
}

/// Embree, verify.cpp, SmallTriangleHitTest, at 8 x 8 instead of 100 x 100: a ray to each centroid.
fn embree_small_triangles() -> (Geometry, Vec<Ray>) {
    let mut mesh = placed(grid(8), 0.25, DVec3::new(-1.0, -1.0, 0.0));
    let (x, y) = DVec3::new(1.0, 2.0, 3.0).normalize().any_orthonormal_pair();
    for v in &mut mesh.vertices {
        *v = (x * f64::from(v.x) + y * f64::from(v.y)).as_vec3();
    }
    let origin = Vec3::new(0.5, 1.0, 2.0);
    let rays = centroids(&mesh).map(|p| toward(origin, p, 1.0)).collect();
    (Geometry::Mesh(mesh), rays)
}

/// After the words of Embree issue 387 (its numbers are not at hand): edges of 11.2, 9.7 and a little over 1.5, met at
/// 0.52 degrees from 600 away, past the triangle, where Embree's robust mode answered t = 12291.2.
fn embree_skinny(draw: &mut Draw) -> (Geometry, Vec<Ray>) {
    let (long, middle, short): (f64, f64, f64) = (11.2, 9.7, 1.52);
    let x = (long * long + short * short - middle * middle) / (2.0 * long);
    let height = (short * short - x * x).sqrt();
    let forward = draw.unit();
    let side = draw.across(forward);
    let normal = forward.cross(side);
    let at = |u: f64, v: f64| forward * u + side * v + DVec3::new(310.0, 95.0, -240.0);
    let [a, b, c] = [at(0.0, 0.0), at(long, 0.0), at(x, height)].map(|p| p.as_vec3());
    let rays = (0..32).map(|_| {
        let turn = draw.range(0.0, std::f64::consts::TAU);
        let (sin, cos) = turn.sin_cos();
        let direction = forward * cos + side * sin + normal * draw.sign() * 0.52_f64.to_radians().tan();
        let target = at(draw.range(-2.0, 13.0), draw.range(-2.0, 3.0));
        let direction = direction.normalize();
        along((target - direction * draw.range(500.0, 600.0)).as_vec3(), direction)
    });
    let rays = rays.collect();
    (Geometry::Mesh(soup(&[Triangle { a, b, c }])), rays)
}
