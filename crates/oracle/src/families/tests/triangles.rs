//! Families 21 to 36: each does what it says, checked in `f64` where that is exact, else by the oracle.

use dashu_ratio::RBig;
use glam::DVec3;
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Triangle};

use super::{cases, line, share, triangle};
use crate::Oracle;

fn mesh(scene: &Scene) -> &Mesh {
    match &scene.geometries()[0] {
        Geometry::Mesh(mesh) => mesh,
        Geometry::Spheres(_) => panic!("spheres"),
    }
}

/// Whether the ray meets a vertex or an edge of some triangle, exactly.
fn on_rim(oracle: &Oracle, ray: &Ray) -> bool {
    let rim = |u: &RBig, v: &RBig| *u == RBig::ZERO || *v == RBig::ZERO || u + v == RBig::ONE;
    oracle.all(ray).iter().any(|hit| rim(&hit.u, &hit.v))
}

/// Whether the line through the origin along `d` holds this point: exact for whole numbers.
fn holds(ray: &Ray, point: glam::Vec3) -> bool {
    (point.as_dvec3() - ray.origin.as_dvec3()).cross(ray.direction.as_dvec3()) == DVec3::ZERO
}

fn normal(t: &Triangle) -> DVec3 {
    (t.b.as_dvec3() - t.a.as_dvec3()).cross(t.c.as_dvec3() - t.a.as_dvec3())
}

#[test]
fn rays_of_21_go_exactly_through_vertices() {
    for (i, case) in cases(21, 2000).iter().enumerate() {
        let mesh = mesh(&case.scene);
        let exact = share(&case.rays, |ray| mesh.vertices.iter().any(|&v| holds(ray, v) && v != ray.origin));
        assert!(exact > 0.99, "scene {i}: {exact}");
        if i < 4 {
            let tip = mesh.triangles.iter().filter(|t| t.contains(&0)).count();
            assert_eq!(tip, [3, 6, 15, 1000][i]);
            assert!(share(&case.rays, |ray| holds(ray, mesh.vertices[0])) > 0.2);
        }
    }
}

#[test]
fn rays_of_22_go_through_edges() {
    for (i, case) in cases(22, 1500).iter().enumerate() {
        let oracle = Oracle::new(&case.scene);
        let near = |ray: &Ray| {
            oracle.all(ray).iter().map(|h| h.to_hit()).any(|h| h.u.min(h.v).min(1.0 - h.u - h.v).abs() < 1e-5)
        };
        let exact = share(&case.rays, |ray| on_rim(&oracle, ray));
        match i % 3 {
            1 => assert!(share(&case.rays, near) > 0.95 && exact < 0.1, "{exact}"),
            _ => assert_eq!(exact, 1.0, "scene {i}"),
        }
    }
}

#[test]
fn numbers_of_23_are_whole_and_tie() {
    for case in cases(23, 1500) {
        let mesh = mesh(&case.scene);
        assert!(mesh.vertices.iter().all(|v| v.fract() == glam::Vec3::ZERO && v.abs().max_element() < 2048.0));
        assert!(
            case.rays
                .iter()
                .all(|r| r.origin.fract() == glam::Vec3::ZERO && (r.direction * 64.0).fract() == glam::Vec3::ZERO)
        );
        let oracle = Oracle::new(&case.scene);
        let in_plane = |ray: &Ray| {
            (0..mesh.triangles.len()).map(|i| mesh.triangle(i)).any(|t| {
                let off = normal(&t).dot(ray.origin.as_dvec3() - t.a.as_dvec3());
                off == 0.0 && normal(&t).dot(ray.direction.as_dvec3()) == 0.0
            })
        };
        let ties = share(&case.rays, |ray| in_plane(ray) || on_rim(&oracle, &line(ray)));
        // Half of them by construction: those aimed at a vertex or at the middle of an edge.
        assert!(ties > 0.4, "{ties}");
    }
}

#[test]
fn triangles_of_24_are_thin_or_have_no_area() {
    for (i, case) in cases(24, 6000).iter().enumerate() {
        let t = triangle(&case.scene);
        let [a, b, c] = [t.a, t.b, t.c].map(|p| p.as_dvec3());
        let longest = [a.distance(b), b.distance(c), c.distance(a)].into_iter().fold(0.0, f64::max);
        let aspect = normal(&t).length() / (longest * longest).max(f64::MIN_POSITIVE);
        match i % 9 {
            k @ 0..6 => assert!(aspect < 5.0 * [1e-3, 1e-5, 1e-7][k % 3], "scene {i}: {aspect:e}"),
            _ => assert_eq!(normal(&t), DVec3::ZERO, "scene {i}"),
        }
        if i % 3 < 2 && i % 9 < 6 {
            let oracle = Oracle::new(&case.scene);
            let hits = share(&case.rays, |ray| oracle.any(ray));
            assert!((0.05..0.98).contains(&hits), "scene {i}: {hits}");
        }
    }
}

#[test]
fn angles_of_25_are_as_said() {
    for (i, case) in cases(25, 6000).iter().enumerate() {
        let t = triangle(&case.scene);
        let n = normal(&t);
        let sine =
            |ray: &Ray| (n.dot(ray.direction.as_dvec3()) / (n.length() * ray.direction.as_dvec3().length())).abs();
        if let Some(nominal) = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7].get(i % 10) {
            assert!(case.rays.iter().all(|ray| (0.35..2.6).contains(&(sine(ray) / nominal))), "scene {i}");
            let oracle = Oracle::new(&case.scene);
            assert!(share(&case.rays, |ray| oracle.any(ray)) > 0.2, "scene {i}");
        } else {
            let off = |ray: &Ray| n.dot(ray.origin.as_dvec3() - t.a.as_dvec3());
            assert!(case.rays.iter().all(|ray| sine(ray) == 0.0), "scene {i}");
            let inside = share(&case.rays, |ray| off(ray) == 0.0);
            assert!((0.4..=1.0).contains(&inside), "scene {i}: {inside}");
            let oracle = Oracle::new(&case.scene);
            assert!(!case.rays.iter().any(|ray| oracle.any(ray)), "a ray in the plane is a miss");
        }
    }
}

#[test]
fn scales_of_26_to_28_are_as_said() {
    for (i, case) in cases(26, 3000).iter().enumerate() {
        let t = triangle(&case.scene);
        let sizes = [t.a, t.b, t.c].map(|p| p.length());
        let (low, high) = [(4e4, 3e5), (1.6e7, 4e7), (4e-6, 3e5)][i % 3];
        assert!(sizes.iter().all(|s| (low..high).contains(s)), "scene {i}: {sizes:?}");
    }
    for (i, case) in cases(27, 5000).iter().enumerate() {
        let nominal = [1e-4, 1e-10, 1e-16, 1e-30, 1e-39, 1e12, 1e18, 1e19, 1e30, 1e38][i % 10];
        let size = mesh(&case.scene).vertices.iter().fold(0.0_f32, |m, v| m.max(v.abs().max_element()));
        assert!((0.05..3.1).contains(&(f64::from(size) / nominal)), "scene {i}: {size:e}");
        let oracle = Oracle::new(&case.scene);
        assert!(share(&case.rays, |ray| oracle.any(ray)) > 0.5, "scene {i}");
    }
    for case in cases(28, 3000) {
        let lengths = |ray: &Ray| ray.direction.as_dvec3().length();
        assert!(share(&case.rays, |ray| lengths(ray) < 1e-15) > 0.05);
        assert!(share(&case.rays, |ray| lengths(ray) > 1e15) > 0.05);
    }
}

#[test]
fn directions_of_29_tie_or_vanish() {
    for (i, case) in cases(29, 3000).iter().enumerate() {
        let special = |ray: &Ray| {
            let d = ray.direction.abs();
            let top = d.max_element();
            let ties = d.to_array().iter().filter(|x| **x >= top.next_down().next_down()).count();
            ties > 1 || d.min_element() == 0.0 || d.min_element() < 1e-28 * top
        };
        assert!(case.rays.iter().all(special));
        let oracle = Oracle::new(&case.scene);
        let exact = share(&case.rays, |ray| on_rim(&oracle, ray));
        assert!(i % 2 == 1 || exact > 0.6, "scene {i}: {exact}");
    }
}

#[test]
fn origins_of_30_are_in_the_plane_or_an_ulp_off() {
    for (i, case) in cases(30, 3000).iter().enumerate() {
        let t = triangle(&case.scene);
        let off = |ray: &Ray| normal(&t).dot(ray.origin.as_dvec3() - t.a.as_dvec3());
        let exact = share(&case.rays, |ray| off(ray) == 0.0);
        assert!(if i % 2 == 0 { exact == 1.0 } else { exact < 0.8 }, "scene {i}: {exact}");
        let oracle = Oracle::new(&case.scene);
        let at_zero = share(&case.rays, |ray| oracle.any(&Ray { t_min: 0.0, t_max: 0.0, ..*ray }));
        assert!(i % 2 == 1 || at_zero > 0.4, "scene {i}: {at_zero}");
    }
}

#[test]
fn edges_of_31_are_passed_by_an_ulp() {
    for (i, case) in cases(31, 2000).iter().enumerate() {
        let (t, oracle) = (triangle(&case.scene), Oracle::new(&case.scene));
        let nominal = [1e4, 1e6][i % 4 / 2];
        assert!(case.rays.iter().all(|ray| (0.3..3.0).contains(&(ray.origin.as_dvec3().length() / nominal))));
        if i % 2 == 1 {
            assert!(case.rays.iter().all(|ray| oracle.any(ray) == (ray.origin.z <= t.a.z)), "scene {i}");
            assert!((0.2..0.8).contains(&share(&case.rays, |ray| oracle.any(ray))));
        }
    }
}

#[test]
fn folds_of_32_are_flat_or_folded() {
    for (i, case) in cases(32, 1500).iter().enumerate() {
        let mesh = mesh(&case.scene);
        let (first, second) = (normal(&mesh.triangle(0)), normal(&mesh.triangle(1)));
        let cosine = first.normalize().dot(second.normalize());
        let oracle = Oracle::new(&case.scene);
        match i % 3 {
            0 => assert!(cosine > 1.0 - 1e-11 && first != second, "{cosine}"),
            1 => assert!(cosine < -1.0 + 1e-11, "{cosine}"),
            _ => {
                assert_eq!(super::super::meshes::open_edges(mesh), 0);
                assert!(case.rays.iter().all(|ray| oracle.count(&line(ray)).is_multiple_of(2)));
            }
        }
        let exact = share(&case.rays, |ray| on_rim(&oracle, &line(ray)));
        assert!(exact > 0.4, "scene {i}: {exact}");
    }
}

#[test]
fn junctions_of_33_leave_the_long_edge() {
    let off = cases(33, 10_000).into_iter().filter(|case| {
        let mesh = mesh(&case.scene);
        let [a, b, middle] = [0, 1, 5].map(|i| mesh.vertices[i].as_dvec3());
        let off = (middle - a).cross(b - a).length() / (b - a).length();
        assert!(off < 2e-7, "{off}");
        off > 0.0
    });
    assert!(off.count() > 30);
}

#[test]
fn weights_of_34_are_at_the_rim() {
    for case in cases(34, 3000) {
        let t = triangle(&case.scene);
        let [a, x, y] = [t.a, t.b - t.a, t.c - t.a].map(|p| p.as_dvec3());
        for ray in &case.rays {
            let (o, d) = (ray.origin.as_dvec3() - a, ray.direction.as_dvec3());
            let n = x.cross(y);
            let p = o - d * (n.dot(o) / n.dot(d));
            let (u, v) = (p.dot(x), p.dot(y));
            let off = u.abs().min(v.abs()).min((1.0 - u - v).abs());
            assert!(off <= 4.0 * (-24_f64).exp2(), "{off:e}: {u} {v}");
        }
        let oracle = Oracle::new(&case.scene);
        assert!(share(&case.rays, |ray| on_rim(&oracle, ray)) > 0.1);
        assert!((0.3..0.9).contains(&share(&case.rays, |ray| oracle.any(ray))));
    }
}

#[test]
fn layers_of_35_tie_and_nearly_tie() {
    let (mut ties, mut near, mut rays) = (0, 0, 0);
    for case in cases(35, 1000) {
        let oracle = Oracle::new(&case.scene);
        for ray in &case.rays {
            let hits = oracle.all(ray);
            rays += 1;
            ties += usize::from(hits.len() > 1 && hits[0].t == hits[1].t);
            let t: Vec<f32> = hits.iter().map(|hit| hit.t.to_f32()).collect();
            near += usize::from(t.windows(2).any(|t| t[0] < t[1] && t[1] <= t[0].next_up().next_up()));
        }
    }
    assert!(ties > rays / 4 && near > rays / 4, "{ties} ties, {near} near, of {rays}");
}

#[test]
fn orders_of_36_are_six_with_the_same_rays() {
    let cases = cases(36, 10_000);
    assert!(cases.len() >= 12 && cases.len().is_multiple_of(6));
    for round in cases.chunks(6) {
        let orders: Vec<Vec<u32>> = round
            .iter()
            .map(|case| mesh(&case.scene).vertices.iter().flat_map(|v| v.to_array()).map(f32::to_bits).collect())
            .collect();
        for (i, case) in round.iter().enumerate() {
            assert_eq!(case.rays, round[0].rays);
            assert!(orders[..i].iter().all(|other| *other != orders[i]), "order {i} twice");
            let mut sorted = [orders[0].clone(), orders[i].clone()];
            sorted.iter_mut().for_each(|bits| bits.sort_unstable());
            assert_eq!(sorted[0], sorted[1], "the same corners");
        }
        let oracle = Oracle::new(&round[0].scene);
        assert!(share(&round[0].rays, |ray| on_rim(&oracle, ray)) > 0.4);
    }
}
