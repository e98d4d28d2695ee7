//! Ranges of every sign, beyond what boxes are told in, and directions of every length: whatever the answer is, each precision
//! gives one, the kernel's is the twin's, and that of `exact` is right.

use glam::Vec3;
use rayproof::Precision;
use rayproof::scene::{FlatHit, Geometry, Mesh, Ray, Scene, Sphere};
use rayproof_cpu::Engine as Cpu;
use rayproof_tree::{Bvh, Scaling};

use crate::conformance::{Pair, Tally, precisions};
use crate::device::gpu;
use crate::exact::{Answers, Engines, Truth, truth};

const ENDS: [f32; 15] =
    [f32::NEG_INFINITY, -3e38, -1e20, -1e5, -4.0, -1e-30, 0.0, 1e-45, 2.0, 4.0, 6.5, 1e5, 1e20, 3e38, f32::INFINITY];
const LENGTHS: [f32; 7] = [1e-45, 1e-30, 1e-10, 1.0, 1e10, 1e30, 3e38];

/// From in, beside and beyond the spheres of a scene as large as `size`, towards and away.
fn rays(size: f32) -> Vec<Ray> {
    let mut rays = Vec::new();
    for length in LENGTHS {
        for (start, way) in [(5.0, -1.0), (5.0, 1.0), (0.25, 1.0), (-5.0, 1.0)] {
            for (i, &t_min) in ENDS.iter().enumerate() {
                let origin = Vec3::new(0.1, 0.2, start) * size;
                let direction = Vec3::new(0.0, 0.0, way) * length;
                rays.extend(ENDS[i..].iter().map(|&t_max| Ray { origin, direction, t_min, t_max }));
            }
        }
    }
    rays
}

fn scenes() -> Vec<(Scene, Vec<Ray>)> {
    let unit = [Sphere::new([0.0; 3], 1.0), Sphere::new([0.0, 0.0, -9.0], 2.0), Sphere::new([40.0, 0.0, 0.0], 1.0)];
    [1.0_f32, 1e-20, 6e36]
        .into_iter()
        .map(|size| {
            let spheres = unit.map(|s| Sphere { center: s.center * size, radius: s.radius * size }).to_vec();
            let corners =
                [[-3.0, -3.0, 2.0], [5.0, -3.0, 2.5], [-3.0, 5.0, 1.5], [-3.0, -3.0, -4.0], [5.0, -3.0, -4.0]];
            let corners = corners.map(|corner| corner.map(|x: f32| x * size)).to_vec();
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [3, 4, 2], [4, 1, 2]]);
            let scene = Scene::new(vec![Geometry::Spheres(spheres), Geometry::Mesh(mesh)]).expect("a valid scene");
            (scene, rays(size))
        })
        .collect()
}

#[test]
fn every_range_has_an_answer_in_every_precision() {
    for (scene, rays) in scenes() {
        let Answers { mut hits, counts, .. } = Engines::new(&scene).on_cpu(&rays);
        for (i, Truth { hit, count }) in truth(&scene, &rays).iter().enumerate() {
            let ray = rays[i];
            assert!(hits[i].same_bits(hit), "{ray:?}: {:?}, not {hit:?}", hits[i]);
            assert_eq!(counts[i], *count, "{ray:?}");
        }
        for precision in Precision::ALL {
            // No panic, whether or not a device runs it.
            let cpu = Cpu::new(Bvh::new(&scene, Scaling::of(precision)).expect("small"), precision);
            cpu.closest(&rays, &mut hits);
            for (ray, hit) in rays.iter().zip(&hits).filter(|(_, hit)| hit.is_hit()) {
                assert!(hit.t >= ray.t_min && hit.t <= ray.t_max, "{precision:?}, {ray:?}: {hit:?}");
            }
        }
        let mut tally = Tally::default();
        for precision in precisions() {
            Pair::new(gpu(), &scene, precision).compare(&format!("ranges, {precision:?}"), &rays, &mut tally);
        }
        println!("{} rays, {} of them hit, 0 wrong, 0 differ", tally.rays, tally.hits);
    }
}

#[test]
fn weights_that_overflow_are_no_hit() {
    // A product of these is infinite in pairs of f32, and what is left of it no number; then one that is so in f32 itself.
    let pairs = [
        [0.0, 1.037_741_1e-38, 5.6e-45],
        [1.000_030_5, 0.0, 0.0],
        [7.369_612e28, 1.090_100_6e27, 5.827_605e-10],
        [1.355_598e-19, 4.544_952e30, 2.103_998_5e-19],
        [1.000_982_3, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let single = [
        [8.6e-43, 0.0, 0.0],
        [562_949_953_421_312.0, 1.235e-40, 0.0],
        [4.878_76e-41, -0.0, 8.8e-44],
        [4.591_8e-41, 951_495_780_466_688.0, 951_495_780_466_688.0],
        [564_467_687_489_536.0, 1.832_514_2e-19, 2.814_656e23],
        [2.8e-45, 1.435e-42, 1.0],
    ];
    let origin = [7.369_612e28, -2.534_211e30, -0.000_411_032_82];
    let cases = [
        (pairs, Ray { t_min: f32::NEG_INFINITY, t_max: 1e5, ..Ray::new(origin, [-0.0, -0.0, -0.760_729_8]) }),
        (single, Ray::new([0.001_168_746_7, 0.0015, -1.511_157_3e23], [-0.001_168_746_7, -0.0015, 0.0])),
    ];
    for (corners, ray) in cases {
        let mesh = Mesh::new(corners, vec![[0, 1, 2], [3, 4, 5]]);
        let scene = Scene::new(vec![Geometry::Mesh(mesh)]).expect("a valid scene");
        for precision in Precision::ALL {
            let cpu = Cpu::new(Bvh::new(&scene, Scaling::of(precision)).expect("small"), precision);
            let mut hits = [FlatHit::MISS];
            cpu.closest(&[ray], &mut hits);
            let [hit] = hits;
            assert!(!(hit.t.is_nan() || hit.u.is_nan() || hit.v.is_nan()), "{precision:?}: {hit:?}");
        }
        let mut tally = Tally::default();
        for precision in precisions() {
            Pair::new(gpu(), &scene, precision).compare(&format!("overflow, {precision:?}"), &[ray], &mut tally);
        }
    }
}
