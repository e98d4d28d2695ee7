//! Families 37 to 40: each does what it says.

use rayproof_scene::{Geometry, Ray};

use super::{bits, cases, line, share};
use crate::Oracle;

#[test]
fn slots_of_37_hold_the_ends_of_f32() {
    let seen: std::collections::HashSet<u32> = cases(37, 10_000).iter().flat_map(bits).collect();
    for end in [0.0, -0.0, f32::from_bits(1), -f32::from_bits(1), f32::MAX, f32::MIN, -f32::MIN_POSITIVE] {
        assert!(seen.contains(&end.to_bits()), "{end:e}");
    }
    for (i, case) in cases(37, 10_000).iter().enumerate() {
        let extreme = |x: f32| x == 0.0 || !(1e-20..1e19).contains(&x.abs());
        if i % 5 == 0 {
            let slots = |ray: &Ray| [ray.origin, ray.direction].iter().any(|v| v.to_array().into_iter().any(extreme));
            assert!(share(&case.rays, |r| slots(r) || r.t_min != 0.0 || r.t_max.is_finite()) > 0.9);
        }
        if i % 5 >= 3 {
            assert!(case.rays.iter().all(|ray| ray.origin.to_array().into_iter().any(extreme)), "scene {i}");
        }
    }
}

#[test]
fn origins_of_38_are_in_the_plane_of_a_zero_component() {
    for case in cases(38, 3000) {
        let Geometry::Mesh(mesh) = &case.scene.geometries()[0] else { panic!("a mesh") };
        let in_plane = |ray: &Ray| {
            let at = |i: usize| ray.direction[i] == 0.0 && mesh.vertices.iter().any(|v| v[i] == ray.origin[i]);
            (0..3).any(at)
        };
        assert!(case.rays.iter().all(in_plane));
        let negative = |ray: &Ray| ray.direction.to_array().iter().any(|x| x.to_bits() == (-0.0_f32).to_bits());
        assert!(share(&case.rays, negative) > 0.3);
    }
}

#[test]
fn rays_of_39_meet_box_corners_or_boxes_of_mixed_size() {
    for (i, case) in cases(39, 3000).iter().enumerate() {
        let Geometry::Mesh(mesh) = &case.scene.geometries()[0] else { panic!("a mesh") };
        if i % 3 < 2 {
            let through = |ray: &Ray| {
                let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
                mesh.vertices.iter().any(|v| (v.as_dvec3() - o).cross(d) == glam::DVec3::ZERO)
            };
            assert!(case.rays.iter().all(through), "scene {i}");
        } else {
            let extent = |t: usize| {
                let t = mesh.triangle(t);
                (t.a.max(t.b).max(t.c) - t.a.min(t.b).min(t.c)).max_element()
            };
            let sizes: Vec<f32> = (0..mesh.triangles.len()).map(extent).collect();
            let (low, high) = sizes.iter().fold((f32::MAX, 0.0_f32), |(l, h), &s| (l.min(s), h.max(s)));
            assert!(high > 16_777_216.0 * low, "{low:e} {high:e}");
        }
        let oracle = Oracle::new(&case.scene);
        assert!(share(&case.rays, |ray| oracle.any(ray)) > 0.1, "scene {i}");
    }
}

#[test]
fn margins_of_40_flip_within_an_ulp() {
    for case in cases(40, 1200) {
        let oracle = Oracle::new(&case.scene);
        let hit = |ray: &Ray| oracle.any(&line(ray));
        let flips = |ray: &Ray| {
            (0..3).any(|axis| {
                [f32::next_up, f32::next_down].iter().any(|step| {
                    let mut moved = *ray;
                    moved.origin[axis] = step(moved.origin[axis]);
                    hit(&moved) != hit(ray)
                })
            })
        };
        assert!(case.rays.iter().all(flips));
        assert!((0.35..0.65).contains(&share(&case.rays, hit)));
        assert!(share(&case.rays, |ray| ray.t_max.is_finite()) > 0.3);
    }
}
