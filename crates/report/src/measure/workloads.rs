//! Scenes of 64 primitives and rays at them: small enough to test every primitive with every ray.

use glam::{DVec3, Vec3};
use rayproof::scene::{Geometry, Mesh, Ray, Scene, Sphere};
use rayproof_oracle::families::Draw;

/// Primitives of a workload.
pub(crate) const PRIMITIVES: usize = 64;

/// What a precision is measured on.
pub(crate) struct Workload {
    /// `sphere` or `triangle`.
    pub(crate) primitive: &'static str,
    /// One sentence.
    pub(crate) name: &'static str,
    make: fn(&mut Draw, usize) -> (Scene, Vec<Ray>),
}

/// The workloads of the plot: an ordinary and a hard one of each primitive.
pub(crate) static ALL: [Workload; 4] = [
    Workload {
        primitive: "sphere",
        name: "Far spheres: 64 of radius 1, seen from 1,000 away; one ray in five is at the rim.",
        make: far_spheres,
    },
    Workload {
        primitive: "sphere",
        name: "Ground spheres: 64 of radius 1,000,000, seen from 1.7 above.",
        make: ground_spheres,
    },
    Workload {
        primitive: "triangle",
        name: "Triangles: 64 of size 1, seen from 100 away; one ray in five is at an edge or a vertex.",
        make: triangles,
    },
    Workload {
        primitive: "triangle",
        name: "Slivers: 64 of size 1 x 1e-5, from 10 away; one ray in five is at an edge or a vertex.",
        make: slivers,
    },
];

impl Workload {
    pub(crate) fn make(&self, seed: u64, number: usize, rays: usize) -> (Scene, Vec<Ray>) {
        (self.make)(&mut Draw::new(seed, 100, number as u64), rays)
    }
}

/// A ray from `origin` at a point, its direction about of length 1.
fn toward(origin: Vec3, target: DVec3) -> Ray {
    Ray::new(origin, (target - origin.as_dvec3()).normalize_or(DVec3::X).as_vec3())
}

/// A point in the ball of that radius about zero.
fn in_ball(draw: &mut Draw, radius: f64) -> DVec3 {
    draw.unit() * radius * draw.range(0.0, 1.0).cbrt()
}

fn far_spheres(draw: &mut Draw, rays: usize) -> (Scene, Vec<Ray>) {
    let spheres: Vec<Sphere> =
        (0..PRIMITIVES).map(|_| Sphere { center: in_ball(draw, 16.0).as_vec3(), radius: 1.0 }).collect();
    let ray = |draw: &mut Draw| {
        let center = spheres[draw.below(PRIMITIVES)].center.as_dvec3();
        let away = draw.unit();
        let off = if draw.chance(0.2) { 1.0 + draw.range(-1e-4, 1e-4) } else { 1.1 * draw.range(0.0, 1.0).sqrt() };
        let target = center + draw.across(away) * off;
        toward((target + away * 1000.0).as_vec3(), target)
    };
    let rays = (0..rays).map(|_| ray(draw)).collect();
    (Scene::new(vec![Geometry::Spheres(spheres)]).expect("made of finite numbers"), rays)
}

fn ground_spheres(draw: &mut Draw, rays: usize) -> (Scene, Vec<Ray>) {
    const RADIUS: f64 = 1e6;
    let sphere = |draw: &mut Draw| {
        let low = DVec3::new(draw.range(-10.0, 10.0), -RADIUS - draw.range(0.0, 1.0), draw.range(-10.0, 10.0));
        Sphere { center: low.as_vec3(), radius: 1e6 }
    };
    let spheres: Vec<Sphere> = (0..PRIMITIVES).map(|_| sphere(draw)).collect();
    let ray = |draw: &mut Draw| {
        let origin = Vec3::new(0.0, 1.7, 0.0);
        let distance = draw.log(0.5, 1000.0);
        let (sin, cos) = draw.range(0.0, std::f64::consts::TAU).sin_cos();
        toward(origin, DVec3::new(distance * cos, -draw.range(0.0, 1.0), distance * sin))
    };
    let rays = (0..rays).map(|_| ray(draw)).collect();
    (Scene::new(vec![Geometry::Spheres(spheres)]).expect("made of finite numbers"), rays)
}

fn triangles(draw: &mut Draw, rays: usize) -> (Scene, Vec<Ray>) {
    let corners = (0..PRIMITIVES).map(|_| {
        let center = in_ball(draw, 8.0);
        [(); 3].map(|()| center + draw.unit() * 0.7)
    });
    let mesh = soup(corners.collect());
    let rays = at_triangles(draw, &mesh, 100.0, rays);
    (Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers"), rays)
}

fn slivers(draw: &mut Draw, rays: usize) -> (Scene, Vec<Ray>) {
    let corners = (0..PRIMITIVES).map(|_| {
        let (from, along) = (in_ball(draw, 1.0), draw.unit());
        let to = from + along;
        let aside = draw.across(along) * 1e-5;
        [from, to, from + along * draw.range(0.1, 0.9) + aside]
    });
    let mesh = soup(corners.collect());
    let rays = at_triangles(draw, &mesh, 10.0, rays);
    (Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers"), rays)
}

fn soup(corners: Vec<[DVec3; 3]>) -> Mesh {
    let triangles = (0..).step_by(3).take(corners.len()).map(|i| [i, i + 1, i + 2]).collect();
    Mesh { vertices: corners.into_iter().flatten().map(|v| v.as_vec3()).collect(), triangles }
}

fn at_triangles(draw: &mut Draw, mesh: &Mesh, distance: f64, rays: usize) -> Vec<Ray> {
    let ray = |draw: &mut Draw| {
        let t = mesh.triangle(draw.below(mesh.triangles.len()));
        let [a, b, c] = [t.a, t.b, t.c].map(|v| v.as_dvec3());
        let (u, v) = (draw.range(0.0, 1.2), draw.range(0.0, 1.2));
        let target = match draw.below(10) {
            0 => a,
            1 => a.lerp(b, draw.range(0.0, 1.0)),
            _ => a + (b - a) * u + (c - a) * v,
        };
        toward((target + draw.unit() * distance).as_vec3(), target)
    };
    (0..rays).map(|_| ray(draw)).collect()
}
