//! The contract's cases with answers known by hand, and exact answers substituted into the equations they solve.

use dashu_ratio::{RBig, Relaxed};
use glam::Vec3;
use rayproof_scene::{FlatHit, Primitive, Ray, Scene, Sphere, Triangle};

use super::{Random, hard_sphere, hard_triangle, mesh, sphere_scene, triangle_scene};
use crate::{
    Oracle,
    rational::{Vector, number, vector},
};

const UNIT: Triangle = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y };

fn closest(scene: &Scene, ray: &Ray) -> FlatHit {
    Oracle::new(scene).closest(ray).map_or(FlatHit::MISS, |hit| hit.to_hit())
}

fn hit(t: f32, u: f32, v: f32, primitive: u32) -> FlatHit {
    FlatHit { t, u, v, primitive }
}

fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray::new(origin, direction)
}

#[test]
fn triangles_are_closed_and_have_two_faces() {
    let scene = triangle_scene(&[UNIT]);
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.25, 0.0), (0.0, 0.75), (0.25, 0.25)] {
        for (z, d) in [(2.0, -4.0), (-2.0, 4.0)] {
            assert_eq!(closest(&scene, &ray([x, y, z], [0.0, 0.0, d])), hit(0.5, x, y, 0));
        }
    }
    let outside = [(0.0_f32.next_down(), 0.0), (1.0_f32.next_up(), 0.0), (0.5, 0.5_f32.next_up())];
    for (x, y) in outside {
        assert_eq!(closest(&scene, &ray([x, y, 2.0], [0.0, 0.0, -1.0])), FlatHit::MISS);
    }
}

#[test]
fn a_ray_in_the_plane_and_a_triangle_without_area_are_misses() {
    let in_plane = [
        ray([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]),
        ray([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ray([0.25, 0.25, 0.0], [1.0, 1.0, 0.0]),
    ];
    for ray in in_plane {
        assert_eq!(closest(&triangle_scene(&[UNIT]), &ray), FlatHit::MISS);
    }
    let flat = [[Vec3::ZERO; 3], [Vec3::ZERO, Vec3::X, Vec3::X], [Vec3::ZERO, Vec3::X, Vec3::X * 3.0]];
    for [a, b, c] in flat {
        let scene = triangle_scene(&[Triangle { a, b, c }]);
        assert_eq!(closest(&scene, &ray([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])), FlatHit::MISS);
    }
    // pbrt-v4's BadCases: x and z of the vertices are all equal.
    let [a, b, c] = [-79.049_614, -87.092_27, -79.209_015].map(|y| Vec3::new(-1_113.454_6, y, -56.243_19));
    let bad =
        Ray { t_max: 0.9999, ..ray([-1_081.479_2, 99.999_954, 87.770_11], [-32.107_3, -183.355_87, -144.607_64]) };
    assert_eq!(closest(&triangle_scene(&[Triangle { a, b, c }]), &bad), FlatHit::MISS);
}

#[test]
fn both_roots_of_a_sphere_count() {
    let scene = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 5.0 }]);
    assert_eq!(closest(&scene, &ray([0.0, 0.0, 10.0], [0.0, 0.0, -2.0])), hit(2.5, 0.0, 0.0, 0));
    assert_eq!(closest(&scene, &ray([0.0, 0.0, 1.0], [0.0, 0.0, -2.0])), hit(3.0, 0.0, 0.0, 0));
    // On the surface, inwards: t = 0 is in range.
    assert_eq!(closest(&scene, &ray([3.0, 4.0, 0.0], [-1.0, 0.0, 0.0])), hit(0.0, 0.0, 0.0, 0));
    let from_inside = Ray { t_min: 0.5, ..ray([3.0, 4.0, 0.0], [-1.0, 0.0, 0.0]) };
    assert_eq!(closest(&scene, &from_inside), hit(6.0, 0.0, 0.0, 0));
    // A tangent is one hit; a hair further out is none.
    let tangent = ray([-2.0, 5.0, 0.0], [1.0, 0.0, 0.0]);
    assert_eq!(Oracle::new(&scene).all(&tangent).len(), 1);
    assert_eq!(closest(&scene, &tangent), hit(2.0, 0.0, 0.0, 0));
    assert_eq!(closest(&scene, &ray([-2.0, 5.0_f32.next_up(), 0.0], [1.0, 0.0, 0.0])), FlatHit::MISS);
    let point = sphere_scene(&[Sphere { center: Vec3::ONE, radius: 0.0 }]);
    assert_eq!(closest(&point, &ray([0.0; 3], [0.5; 3])), hit(2.0, 0.0, 0.0, 0));
    assert_eq!(closest(&point, &ray([0.0; 3], [1.0, 1.0, 1.0_f32.next_up()])), FlatHit::MISS);
}

#[test]
fn the_range_holds_its_ends() {
    let scene = triangle_scene(&[UNIT]);
    let through =
        |t_min: f32, t_max: f32| closest(&scene, &Ray { t_min, t_max, ..ray([0.25, 0.25, 3.0], [0.0, 0.0, -1.0]) }).t;
    let (inf, up, down) = (f32::INFINITY, 3.0_f32.next_up(), 3.0_f32.next_down());
    for (low, high) in [(3.0, 3.0), (0.0, 3.0), (3.0, inf), (-inf, inf), (-inf, 3.0)] {
        assert_eq!(through(low, high), 3.0, "{low} {high}");
    }
    for (low, high) in [(0.0, down), (up, inf), (-inf, down), (inf, inf), (-inf, -inf)] {
        assert_eq!(through(low, high), inf, "{low} {high}");
    }
    // sqrt(2) lies a little above the f32 nearest to it: a range that ends there does not hold it.
    let ball = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 2.0 }]);
    let root = std::f32::consts::SQRT_2;
    assert!(f64::from(root) < std::f64::consts::SQRT_2);
    let chord = ray([0.0, 1.0, 1.0], [1.0, 0.0, 0.0]);
    assert_eq!(closest(&ball, &Ray { t_max: root.next_up(), ..chord }).t, root);
    assert_eq!(closest(&ball, &Ray { t_max: root, ..chord }), FlatHit::MISS);
    assert_eq!(closest(&ball, &Ray { t_min: root, ..chord }).t, root);
    assert_eq!(closest(&ball, &Ray { t_min: root.next_up(), ..chord }), FlatHit::MISS);
}

#[test]
fn ties_go_to_the_lowest_number_across_geometries() {
    let ball = Sphere { center: Vec3::new(0.25, 0.25, -1.0), radius: 1.0 };
    let scene = Scene::new(vec![
        rayproof_scene::Geometry::Spheres(vec![]),
        mesh(&[Triangle { a: Vec3::Z * 9.0, ..UNIT }]),
        rayproof_scene::Geometry::Spheres(vec![ball, ball]),
        mesh(&[UNIT, UNIT]),
    ])
    .expect("a valid scene");
    let down = Ray { t_min: 0.0, ..ray([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]) };
    let all: Vec<_> = Oracle::new(&scene).all(&down).iter().map(|h| (h.to_hit().t, h.primitive)).collect();
    assert_eq!(all, [(1.0, 1), (1.0, 2), (1.0, 3), (1.0, 4), (3.0, 1), (3.0, 2)]);
    assert_eq!(closest(&scene, &down).primitive, 1);
}

#[test]
fn a_faulty_ray_hits_nothing_and_a_huge_t_is_infinite() {
    let scene = triangle_scene(&[UNIT]);
    let good = ray([0.25, 0.25, 1.0e30], [0.0, 0.0, -1.0e-30]);
    assert_eq!(closest(&scene, &good), hit(f32::INFINITY, 0.25, 0.25, 0));
    for bad in
        [Ray { direction: Vec3::ZERO, ..good }, Ray { t_min: f32::NAN, ..good }, Ray { t_min: 2.0, t_max: 1.0, ..good }]
    {
        assert_eq!(closest(&scene, &bad), FlatHit::MISS);
        assert_eq!(Oracle::new(&scene).count(&bad), 0);
    }
}

fn along(e: &Vector, t: &Relaxed, d: &Vector) -> Vector {
    std::array::from_fn(|i| &e[i] + t * &d[i])
}

/// Every hit solves the surface's equation and the ray's, exactly.
#[test]
fn hits_solve_their_equations() {
    let mut random = Random::new(0x5eed_0003);
    let (mut on_triangles, mut on_spheres) = (0, 0);
    for _ in 0..4_000 {
        let (triangle, ray) = hard_triangle(&mut random);
        let (scene, [e, d]) = (triangle_scene(&[triangle]), [ray.origin, ray.direction].map(vector));
        for hit in Oracle::new(&scene).all(&ray) {
            let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(vector);
            let [u, v, t] = [hit.u, hit.v, rational(&hit.t)].map(RBig::relax);
            let p: Vector = std::array::from_fn(|i| &a[i] + &u * (&b[i] - &a[i]) + &v * (&c[i] - &a[i]));
            assert_eq!(along(&e, &t, &d), p);
            assert!(u >= Relaxed::ZERO && v >= Relaxed::ZERO && u + v <= Relaxed::ONE);
            on_triangles += 1;
        }
        let (sphere, ray) = hard_sphere(&mut random);
        let (scene, [e, d]) = (sphere_scene(&[sphere]), [ray.origin, ray.direction].map(vector));
        for hit in Oracle::new(&scene).all(&ray) {
            // With t = p + s, s^2 = D: |o + p d|^2 + D d.d = r^2, and (o + p d).d = 0.
            let (p, square) = hit.t.parts();
            let at = along(&e, &p.clone().relax(), &d);
            let o: Vector = std::array::from_fn(|i| &at[i] - &vector(sphere.center)[i]);
            let dot = crate::rational::dot;
            assert_eq!(dot(&o, &o) + square.clone().relax() * dot(&d, &d), number(sphere.radius).sqr());
            assert_eq!(dot(&o, &d), Relaxed::ZERO);
            on_spheres += 1;
        }
    }
    println!("{on_triangles} hits on triangles, {on_spheres} on spheres");
    assert!(on_triangles > 500 && on_spheres > 500);
}

/// The rational that a triangle's `t` is.
fn rational(t: &crate::Root) -> RBig {
    let (p, square) = t.parts();
    assert!(square.is_zero());
    p.clone()
}

/// The order of the vertices changes no hit, and its weights only as it must.
#[test]
fn vertex_order_does_not_matter() {
    let mut random = Random::new(0x5eed_0004);
    let mut hits = 0;
    for _ in 0..2_000 {
        let (Triangle { a, b, c }, ray) = hard_triangle(&mut random);
        let orders = [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [b, a, c], [c, b, a]];
        let weights = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]];
        let answers = orders.map(|[a, b, c]| Oracle::new(&triangle_scene(&[Triangle { a, b, c }])).closest(&ray));
        let Some(first) = answers[0].clone() else {
            assert!(answers.iter().all(Option::is_none));
            continue;
        };
        let all = [RBig::ONE - &first.u - &first.v, first.u, first.v];
        for (answer, order) in answers.into_iter().zip(weights) {
            let answer = answer.unwrap();
            assert_eq!((answer.t, answer.u, answer.v), (first.t.clone(), all[order[1]].clone(), all[order[2]].clone()));
        }
        hits += 1;
    }
    println!("{hits} hits");
    assert!(hits > 300);
}

#[test]
fn queries_agree_with_each_other() {
    let mut random = Random::new(0x5eed_0005);
    let pairs: Vec<_> = (0..60).map(|_| (hard_triangle(&mut random), hard_sphere(&mut random))).collect();
    let (triangles, spheres): (Vec<_>, Vec<_>) = pairs.iter().map(|(t, s)| (t.0, s.0)).unzip();
    let scene = Scene::new(vec![mesh(&triangles), rayproof_scene::Geometry::Spheres(spheres)]).expect("a valid scene");
    let oracle = Oracle::new(&scene);
    let rays: Vec<_> = pairs.iter().flat_map(|(t, s)| [t.1, s.1]).collect();
    let closest = oracle.batch(&rays, Oracle::closest);
    let mut hits = 0;
    for (ray, closest) in rays.iter().zip(closest) {
        let all = oracle.all(ray);
        assert_eq!(all.first(), closest.as_ref());
        assert_eq!(oracle.any(ray), closest.is_some());
        assert!(all.is_sorted_by(|a, b| (&a.t, a.primitive) <= (&b.t, b.primitive)));
        let kinds = all.iter().map(|h| matches!(scene.primitive(h.primitive as usize), Primitive::Sphere(_)));
        hits += kinds.filter(|&sphere| sphere).count();
    }
    assert!(hits > 30, "{hits}");
}
