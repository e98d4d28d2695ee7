//! Families 1 to 20: each does what it says, checked in `f64` where that is exact enough, else by the oracle.

use glam::DVec3;
use rayproof_scene::{Ray, Sphere};

use super::{cases, line, share, sphere};
use crate::Oracle;

/// The origin from the centre: exact where the exponents are near each other.
fn o(ray: &Ray, sphere: &Sphere) -> DVec3 {
    ray.origin.as_dvec3() - sphere.center.as_dvec3()
}

/// How far from the centre the line passes, in radii.
fn impact(ray: &Ray, sphere: &Sphere) -> f64 {
    let d = ray.direction.as_dvec3();
    o(ray, sphere).cross(d).length() / d.length() / f64::from(sphere.radius)
}

/// The exact roots over all t, rounded.
fn roots(oracle: &Oracle, ray: &Ray) -> Vec<f32> {
    oracle.all(&line(ray)).iter().map(|hit| hit.t.to_f32()).collect()
}

#[test]
fn distances_of_1_reach_from_10_to_1e7() {
    for (i, case) in cases(1, 5000).iter().enumerate() {
        let (sphere, nominal) = (sphere(&case.scene), [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7][i % 7]);
        assert!(case.rays.iter().all(|ray| (0.3..3.3).contains(&(o(ray, &sphere).length() / nominal))));
        if nominal < 1e5 {
            let inside = share(&case.rays, |ray| impact(ray, &sphere) < 1.0);
            assert!((0.8..1.0).contains(&inside), "{inside} of scene {i}");
        }
    }
}

#[test]
fn impacts_of_2_are_within_1001_times_2_to_the_minus_24() {
    for case in cases(2, 5000) {
        let sphere = sphere(&case.scene);
        for ray in &case.rays {
            let (off, distance) = (impact(ray, &sphere) - 1.0, o(ray, &sphere).length());
            assert!(off.abs() < 1003.0 * (-24_f64).exp2(), "{off:e} {ray:?}");
            assert!((2e5..4e6).contains(&distance), "{distance}");
        }
        let inside = share(&case.rays, |ray| impact(ray, &sphere) < 1.0);
        assert!((0.3..0.7).contains(&inside), "{inside}");
    }
}

#[test]
fn impacts_of_3_come_within_ten_to_the_minus_k() {
    for (i, case) in cases(3, 5000).iter().enumerate() {
        let sphere = sphere(&case.scene);
        let near = 3.0 * [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7][i % 7];
        // Directions of any slope round by about 1e-6 at this distance: below that only the exact half can be near.
        let within = share(&case.rays, |ray| (impact(ray, &sphere) - 1.0).abs() <= near);
        assert!(within > if near > 1e-5 { 0.99 } else { 0.45 }, "{within} of scene {i}");
    }
}

#[test]
fn tangents_of_4_are_exact() {
    for case in cases(4, 600) {
        let oracle = Oracle::new(&case.scene);
        for ray in &case.rays {
            assert_eq!((oracle.all(ray).len(), oracle.count(ray)), (1, 2), "{ray:?} {:?}", case.scene);
        }
    }
}

#[test]
fn eyes_of_5_and_6_are_just_above_the_ground() {
    for (number, most) in [(5, 400.0 / 3e5), (6, 4.0 / 6e6)] {
        for case in cases(number, 4000) {
            let sphere = sphere(&case.scene);
            let r = f64::from(sphere.radius);
            assert!(case.rays.iter().all(|ray| (o(ray, &sphere).length() - r).abs() < most * r), "family {number}");
            let oracle = Oracle::new(&case.scene);
            let hits = share(&case.rays, |ray| oracle.any(ray));
            assert!((0.2..=0.95).contains(&hits), "family {number}: {hits}");
        }
    }
}

#[test]
fn origins_of_7_are_exactly_on_the_surface() {
    for case in cases(7, 800) {
        let oracle = Oracle::new(&case.scene);
        for ray in &case.rays {
            assert!(oracle.any(&Ray { t_min: 0.0, t_max: 0.0, ..*ray }), "{ray:?} {:?}", case.scene);
        }
    }
}

#[test]
fn origins_of_8_are_near_the_surface_and_those_of_9_inside() {
    for case in cases(8, 3000) {
        let sphere = sphere(&case.scene);
        let away = |ray: &Ray| o(ray, &sphere).length() / f64::from(sphere.radius) - 1.0;
        assert!(case.rays.iter().all(|ray| away(ray).abs() < 1.1 / 1024.0));
        assert!((0.3..0.7).contains(&share(&case.rays, |ray| away(ray) < 0.0)));
    }
    for (i, case) in cases(9, 3000).iter().enumerate() {
        let sphere = sphere(&case.scene);
        let most = [0.0, 1e-10, 0.999 * f64::from(sphere.radius)][i % 3];
        assert!(case.rays.iter().all(|ray| o(ray, &sphere).length() <= most), "scene {i}");
    }
}

#[test]
fn directions_of_10_are_at_right_angles_and_those_of_20_almost() {
    for case in cases(10, 3000) {
        let sphere = sphere(&case.scene);
        let exact = share(&case.rays, |ray| o(ray, &sphere).dot(ray.direction.as_dvec3()) == 0.0);
        assert_eq!(exact, 1.0);
        let outside = share(&case.rays, |ray| o(ray, &sphere).length() > f64::from(sphere.radius));
        assert!((0.1..0.9).contains(&outside), "{outside}");
    }
    for case in cases(20, 3000) {
        let sphere = sphere(&case.scene);
        let noise = |ray: &Ray| {
            let (o, d) = (o(ray, &sphere), ray.direction.as_dvec3());
            (o.dot(d) / (o.length() * d.length())).abs()
        };
        assert!(case.rays.iter().all(|ray| noise(ray) < (-22_f64).exp2()));
        assert!(share(&case.rays, |ray| noise(ray) > 1e-12) > 0.9, "noise, not zero");
    }
}

#[test]
fn directions_of_11_to_13_leave_the_range_of_their_squares() {
    for (i, case) in cases(11, 3000).iter().enumerate() {
        let square = |ray: &Ray| ray.direction.dot(ray.direction);
        let lost = share(&case.rays, |ray| square(ray) < f32::MIN_POSITIVE);
        assert_eq!(lost > 0.9, i % 7 >= 3, "scene {i}: {lost}");
        let oracle = Oracle::new(&case.scene);
        assert!((0.3..0.9).contains(&share(&case.rays, |ray| oracle.any(ray))), "scene {i}");
    }
    for (i, case) in cases(12, 3000).iter().enumerate() {
        let lost = share(&case.rays, |ray| ray.direction.dot(ray.direction).is_infinite());
        assert_eq!(lost > 0.9, i % 5 >= 3, "scene {i}: {lost}");
    }
    for case in cases(13, 1000) {
        assert!(case.rays.iter().all(|ray| ray.direction.abs().max_element() <= f32::MIN_POSITIVE));
        let oracle = Oracle::new(&case.scene);
        assert!((0.3..0.95).contains(&share(&case.rays, |ray| oracle.any(ray))));
    }
}

#[test]
fn spheres_of_14_to_16_are_huge_or_below_an_ulp() {
    for (i, case) in cases(14, 2000).iter().enumerate() {
        let sphere = sphere(&case.scene);
        let lost = share(&case.rays, |ray| {
            let o = ray.origin - sphere.center;
            let b = o.dot(ray.direction);
            o.length_squared().is_infinite() || (b * b).is_infinite()
        });
        assert!(lost > if i % 5 < 2 { 0.2 } else { 0.99 }, "scene {i}: {lost}");
    }
    for (i, case) in cases(15, 3000).iter().enumerate() {
        let sphere = sphere(&case.scene);
        let far = sphere.center.abs().max_element();
        assert!(sphere.radius < 2.1e-6 * far.max(1.0) && (sphere.radius > 0.0) == (i % 7 < 4), "scene {i}: {sphere:?}");
        let oracle = Oracle::new(&case.scene);
        let hits = share(&case.rays, |ray| oracle.any(ray));
        assert!((0.05..0.9).contains(&hits), "scene {i}: {hits}");
    }
    for case in cases(16, 2000) {
        let far = sphere(&case.scene).center.abs().max_element();
        assert!(far > 3e4 && far.next_up() - far > 1e-3);
        let oracle = Oracle::new(&case.scene);
        let hits = share(&case.rays, |ray| oracle.any(ray));
        assert!(hits > 0.0, "{hits}");
    }
}

#[test]
fn differences_of_17_lose_the_bits_that_decide() {
    let mut verdicts = [0, 0];
    for case in cases(17, 1000) {
        let (sphere, oracle) = (sphere(&case.scene), Oracle::new(&case.scene));
        for ray in &case.rays {
            let lost = (ray.origin - sphere.center).as_dvec3() != o(ray, &sphere);
            assert!(lost, "{ray:?} {sphere:?}");
            // Rounded, the origin passes at the radius or at most an ulp from it.
            assert!((impact(ray, &sphere) - 1.0).abs() < 3e-7);
            verdicts[usize::from(oracle.any(ray))] += 1;
        }
    }
    assert!(verdicts.iter().all(|&n| n > 200), "{verdicts:?}");
}

#[test]
fn roots_of_18_meet_each_other_or_the_ends() {
    for (i, case) in cases(18, 900).iter().enumerate() {
        let oracle = Oracle::new(&case.scene);
        let close = |a: f32, b: f32| a == b || a.next_up() == b || a.next_down() == b;
        let at_end = |ray: &Ray| {
            let roots = roots(&oracle, ray);
            assert_eq!(roots.len(), 2);
            roots.iter().any(|&t| close(t, ray.t_min) || close(t, ray.t_max))
        };
        if i % 3 == 0 {
            for ray in &case.rays {
                let roots = roots(&oracle, ray);
                assert!(roots.len() == 2 && close(roots[0], roots[1]), "{roots:?}");
            }
        } else {
            let at_end = share(&case.rays, at_end);
            assert!(at_end > 0.85, "scene {i}: {at_end}");
        }
    }
}

#[test]
fn surfaces_of_19_are_behind_by_ulps_or_touched_behind() {
    for (i, case) in cases(19, 600).iter().enumerate() {
        let oracle = Oracle::new(&case.scene);
        let radius = f64::from(sphere(&case.scene).radius);
        for ray in &case.rays {
            let roots = roots(&oracle, ray);
            let far = f64::from(roots[roots.len() - 1]) * ray.direction.as_dvec3().length() / radius;
            if i % 2 == 0 {
                assert!(roots.len() == 2 && far.abs() <= 3.0 * f64::from(f32::EPSILON), "{roots:?}");
            } else {
                assert!(roots.len() == 1 && far <= -1.0, "{roots:?}");
            }
        }
        let hits = share(&case.rays, |ray| oracle.any(ray));
        assert!((0.2..0.8).contains(&hits), "{hits}");
    }
}
