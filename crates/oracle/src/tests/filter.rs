//! The filter changes no answer, and pays.

use std::{
    f64::consts::{PI, TAU},
    time::Instant,
};

use glam::Vec3;
use rayproof_scene::{Geometry, Mesh, Ray, Scene};

use super::{Random, hard_sphere, hard_triangle, mesh, sphere_scene, triangle_scene};
use crate::{Oracle, filter::Filter, rational::Line, sphere::Roots, triangle::PlanePoint};

fn assert_same(scene: &Scene, ray: &Ray) {
    let (fast, slow) = (Oracle::new(scene), Oracle::new(scene).without_filter());
    assert_eq!(fast.all(ray), slow.all(ray), "{ray:?}");
    assert_eq!(fast.count(ray), slow.count(ray), "{ray:?}");
}

#[test]
fn one_hard_primitive() {
    let mut random = Random::new(0x5eed_0020);
    for _ in 0..20_000 {
        let (triangle, ray) = hard_triangle(&mut random);
        assert_same(&triangle_scene(&[triangle]), &ray);
        let (sphere, ray) = hard_sphere(&mut random);
        assert_same(&sphere_scene(&[sphere]), &ray);
    }
}

#[test]
fn all_against_all() {
    let mut random = Random::new(0x5eed_0021);
    let cases: Vec<_> = (0..80).map(|_| (hard_triangle(&mut random), hard_sphere(&mut random))).collect();
    let triangles: Vec<_> = cases.iter().map(|(t, _)| t.0).collect();
    let scene = Scene::new(vec![mesh(&triangles), Geometry::Spheres(cases.iter().map(|(_, s)| s.0).collect())])
        .expect("a valid scene");
    for ray in cases.iter().flat_map(|(t, s)| [t.1, s.1]) {
        assert_same(&scene, &ray);
    }
}

/// Rejections are of true misses, near the largest and the smallest numbers too, and most true misses are rejected.
#[test]
fn at_the_ends_of_the_number_range() {
    let mut random = Random::new(0x5eed_0022);
    let (mut misses, mut rejected, mut sphere_misses, mut spheres_rejected) = (0, 0, 0, 0);
    for _ in 0..20_000 {
        let mut any = || {
            let mut component = || {
                let x = random.uniform(-1.0, 1.0);
                match random.below(5) {
                    0 => x * 3.4e38,
                    1 => x * 1.0e-38,
                    2 => f32::from_bits(random.below(4)),
                    3 => x,
                    _ => x * 2.0_f32.powi(i32::try_from(random.below(250)).unwrap() - 125),
                }
            };
            Vec3::new(component(), component(), component())
        };
        let [a, b, c, e, d] = [(); 5].map(|()| any());
        if d == Vec3::ZERO {
            continue;
        }
        let (ray, triangle) = (Ray::new(e, d), rayproof_scene::Triangle { a, b, c });
        let (line, filter) = (Line::new(&ray), Filter::new(&ray));
        let codes = [a, b, c].map(|v| filter.outcode(v));
        let reject = codes[0] & codes[1] & codes[2] != 0 || filter.misses_triangle(&triangle);
        let hit = PlanePoint::new(&line, &triangle).is_some_and(|p| p.is_inside());
        assert!(!(reject && hit), "{ray:?} {triangle:?}");
        misses += usize::from(!hit);
        rejected += usize::from(reject);

        let sphere = rayproof_scene::Sphere { center: a, radius: b.x.abs() };
        let hit = !matches!(Roots::new(&line, &sphere), Roots::None);
        assert!(!(filter.misses_sphere(&sphere) && hit), "{ray:?} {sphere:?}");
        sphere_misses += usize::from(!hit);
        spheres_rejected += usize::from(filter.misses_sphere(&sphere));
        // An exact tangent.
        let (e, d) = (Vec3::new(e.x, a.y, 0.0), Vec3::X * d.x);
        let tangent = Filter::new(&Ray::new(e, d))
            .misses_sphere(&rayproof_scene::Sphere { center: Vec3::X * a.x, radius: a.y.abs() });
        assert!(!tangent || d == Vec3::ZERO);
    }
    println!("{rejected} of {misses} misses of triangles rejected");
    println!("{spheres_rejected} of {sphere_misses} misses of spheres rejected");
    assert!(10 * rejected > 9 * misses && 100 * spheres_rejected > 99 * sphere_misses);
}

/// A tangent from so far that `e - c` needs more bits than `f64` has: the sphere moves by less than the last of them.
#[test]
fn near_tangents_from_afar() {
    let mut random = Random::new(0x5eed_0024);
    let (d, foot) = (Vec3::new(4.0, 3.0, 0.0), Vec3::new(-3.0, 4.0, 0.0));
    let ray = Ray::new(foot - d * 4_000_000.0, d);
    let (line, filter, mut hits) = (Line::new(&ray), Filter::new(&ray), 0);
    for _ in 0..2_000 {
        let sphere = rayproof_scene::Sphere { center: random.vector() * 2.0_f32.powi(-26), radius: 5.0 };
        let hit = !matches!(Roots::new(&line, &sphere), Roots::None);
        assert!(!(hit && filter.misses_sphere(&sphere)), "{sphere:?}");
        hits += usize::from(hit);
    }
    assert!((500..1_500).contains(&hits), "{hits}");
}

/// A bumpy globe of 871,200 triangles: every ray from inside hits it.
#[test]
fn a_large_mesh_is_fast() {
    let (rows, columns) = (660_u32, 660_u32);
    let vertex = |i: u32, j: u32| {
        let (theta, phi) = (f64::from(i) / f64::from(rows) * PI, f64::from(j) / f64::from(columns) * TAU);
        let radius = 1.0 + 0.05 * (9.0 * theta).sin() * (7.0 * phi).sin();
        (glam::DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()) * radius).as_vec3()
    };
    let vertices = (0..=rows).flat_map(|i| (0..columns).map(move |j| vertex(i, j))).collect();
    let at = |i: u32, j: u32| i * columns + j % columns;
    let quads =
        (0..rows).flat_map(|i| (0..columns).map(move |j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    let triangles: Vec<_> = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let scene = Scene::new(vec![Geometry::Mesh(Mesh { vertices, triangles })]).expect("a valid scene");
    let mut random = Random::new(0x5eed_0023);
    let rays: Vec<_> =
        (0..20).map(|_| Ray::new(random.vector() * 0.3, random.vector() + Vec3::new(2.0, 0.0, 0.0))).collect();
    let oracle = Oracle::new(&scene);
    let start = Instant::now();
    let hits = rays.iter().filter(|ray| oracle.closest(ray).is_some()).count();
    println!("{} triangles: {:.1} ms a ray", scene.len(), start.elapsed().as_secs_f64() * 1e3 / rays.len() as f64);
    assert_eq!(hits, rays.len());
}
