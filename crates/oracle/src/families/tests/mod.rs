#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "a test, whose failures name the seed")]

use std::collections::HashSet;

use rayproof_scene::{Geometry, Primitive, Ray, Scene, Sphere, Triangle};

use super::{BATCH_SIZES, Case, all, batch, batch_answer, invalid_rays, invalid_spheres, invalid_triangles};
use crate::Oracle;

mod fields;
mod spheres;
mod traversals;
mod triangles;

/// Printed by every failure: the seed of all tests here.
const SEED: u64 = 20_261_123;

/// The cases of a family by its number, by variant: the scenes of variant i are at i, i + variants, ...
fn cases(number: usize, rays: usize) -> Vec<Case> {
    let family = &all()[number - 1];
    println!("family {number} ({}), seed {SEED}", family.name);
    let cases = family.cases(SEED, rays);
    assert!(!cases.is_empty());
    cases
}

fn sphere(scene: &Scene) -> Sphere {
    match scene.primitive(0) {
        Primitive::Sphere(sphere) => sphere,
        Primitive::Triangle(_) => panic!("a triangle"),
    }
}

fn triangle(scene: &Scene) -> Triangle {
    match scene.primitive(0) {
        Primitive::Triangle(triangle) => triangle,
        Primitive::Sphere(_) => panic!("a sphere"),
    }
}

/// The part of some rays, 0 to 1, that a predicate holds for.
fn share(rays: &[Ray], holds: impl Fn(&Ray) -> bool) -> f64 {
    rays.iter().filter(|ray| holds(ray)).count() as f64 / rays.len() as f64
}

/// The ray over all t.
fn line(ray: &Ray) -> Ray {
    Ray { t_min: f32::NEG_INFINITY, t_max: f32::INFINITY, ..*ray }
}

fn bits(case: &Case) -> Vec<u32> {
    let mut floats = Vec::new();
    for geometry in case.scene.geometries() {
        match geometry {
            Geometry::Mesh(mesh) => floats.extend(mesh.vertices.iter().flat_map(|v| v.to_array())),
            Geometry::Spheres(all) => floats.extend(all.iter().flat_map(|s| s.center.extend(s.radius).to_array())),
        }
    }
    for ray in &case.rays {
        floats.extend(ray.origin.extend(ray.t_min).to_array());
        floats.extend(ray.direction.extend(ray.t_max).to_array());
    }
    floats.into_iter().map(f32::to_bits).collect()
}

#[test]
fn the_families_are_numbered_and_named() {
    assert_eq!(all().len(), 42);
    for (i, family) in all().iter().enumerate() {
        assert_eq!(family.number as usize, i + 1);
        assert!(family.stresses.ends_with('.') && family.stresses.len() > 30, "{}", family.stresses);
    }
    assert_eq!(all().iter().map(|f| f.name).collect::<HashSet<_>>().len(), 42);
}

fn sound(geometry: &Geometry) -> bool {
    match geometry {
        Geometry::Mesh(mesh) => {
            let known = |t: &[u32; 3]| t.iter().all(|&i| (i as usize) < mesh.vertices.len());
            mesh.vertices.iter().all(|v| v.is_finite()) && mesh.triangles.iter().all(known)
        }
        Geometry::Spheres(spheres) => {
            spheres.iter().all(|s| s.center.is_finite() && s.radius.is_finite() && s.radius >= 0.0)
        }
    }
}

#[test]
fn every_family_gives_valid_cases_of_about_the_amount_asked() {
    for (family, asked) in all().iter().flat_map(|f| [0, 1, 7, 64, 1000, 10_000].map(|n| (f, n))) {
        for seed in SEED..SEED + 3 {
            let cases = family.cases(seed, asked);
            let place = format!("family {} ({}), seed {seed}, {asked} rays", family.number, family.name);
            let total: usize = cases.iter().map(|c| c.rays.len()).sum();
            assert!(total <= asked && total + 40 >= asked, "{place}: {total}");
            assert!(cases.len() <= 40, "{place}: {} scenes", cases.len());
            for case in &cases {
                assert!(!case.scene.is_empty() && case.scene.len() <= 2000, "{place}: {} primitives", case.scene.len());
                assert!(case.scene.geometries().iter().all(sound), "{place}: {:?}", case.scene);
                let fault = case.rays.iter().find_map(|ray| ray.fault().map(|f| (ray, f)));
                assert_eq!(fault, None, "{place}");
                let enough = asked < 10_000 || family.number == 42 || case.rays.len() >= 64;
                assert!(enough && !case.rays.is_empty(), "{place}: {} in a scene", case.rays.len());
            }
        }
    }
}

#[test]
fn a_seed_gives_the_same_bits_and_another_seed_others() {
    for family in all() {
        let of = |seed| family.cases(seed, 1000).iter().flat_map(bits).collect::<Vec<u32>>();
        assert_eq!(of(SEED), of(SEED), "family {}", family.number);
        assert_eq!(of(SEED) == of(SEED + 1), family.number == 42, "family {}", family.number);
    }
}

#[test]
fn the_invalid_have_one_fault_each() {
    let rays = invalid_rays();
    assert_eq!(rays.len(), 40);
    for (label, ray) in &rays {
        assert!(ray.fault().is_some(), "{label}");
        let spoiled = ray.origin.to_array().into_iter().chain(ray.direction.to_array()).filter(|x| !x.is_finite());
        assert_eq!(
            spoiled.count(),
            usize::from(
                label.starts_with("origin") || label.contains("n x") || label.contains("n y") || label.contains("n z")
            ),
            "{label}"
        );
    }
    let spheres = invalid_spheres();
    assert_eq!(spheres.len(), 23);
    for (label, s) in &spheres {
        let spoiled = s.center.extend(s.radius).to_array().into_iter().filter(|x| !x.is_finite()).count();
        assert_eq!(spoiled + usize::from(s.radius.is_finite() && s.radius < 0.0), 1, "{label}");
    }
    let triangles = invalid_triangles();
    assert_eq!(triangles.len(), 45);
    for (label, t) in &triangles {
        let spoiled = [t.a, t.b, t.c].into_iter().flat_map(|v| v.to_array()).filter(|x| !x.is_finite()).count();
        assert_eq!(spoiled, 1, "{label}");
    }
    // Moving a float must not quieten it.
    let signalling = |label: &str, x: f32| label.contains("signalling") && x.to_bits() == 0x7fa0_0001;
    assert_eq!(rays.iter().filter(|(l, r)| signalling(l, r.origin.x + 0.0) || signalling(l, r.t_min)).count(), 1);
    assert_eq!(rays.iter().filter(|(l, r)| signalling(l, r.direction.z)).count(), 1);
    assert_eq!(spheres.iter().filter(|(l, s)| signalling(l, s.radius)).count(), 1);
    let labels: HashSet<_> = rays.iter().map(|r| r.0).collect();
    assert_eq!(labels.len(), rays.len(), "a label twice");
}

#[test]
fn a_batch_tells_each_ray_from_its_neighbours() {
    assert_eq!(BATCH_SIZES, [0, 1, 63, 64, 65, 65_536, 65_537, 4_194_305]);
    for &n in &BATCH_SIZES[..5] {
        assert_eq!(batch(n).rays.len(), n);
    }
    let case = batch(300);
    let oracle = Oracle::new(&case.scene);
    for (i, ray) in case.rays.iter().enumerate() {
        let exact = oracle.closest(ray).map_or(rayproof_scene::FlatHit::MISS, |hit| hit.to_hit());
        assert!(exact.same_bits(&batch_answer(i)), "ray {i}: {exact:?}, {:?}", batch_answer(i));
    }
    // A batch cut or wrapped at a power of two gives a ray another ray's answer: they must differ.
    for i in (0..4_194_305).filter(|i| i % 7 != 6) {
        for step in [1, 64, 128, 65_536, 65_535 * 64] {
            assert!(i < step || !batch_answer(i).same_bits(&batch_answer(i - step)), "rays {i} and {}", i - step);
        }
    }
    let sizes: Vec<usize> = all()[41].cases(SEED, 10_000).iter().map(|c| c.rays.len()).collect();
    assert_eq!(sizes, [1, 63, 64, 65, 9807]);
}
