//! Far spheres grazed at the rim, and the ground under an eye.

use glam::Vec3;
use rayproof::scene::{Geometry, Ray, Scene, Sphere};

use super::{Engines, Truth, rays, truth};
use crate::scenes::Numbers;

/// Both engines against the oracle, in every bit; how many rays hit.
fn compare(what: &str, scene: &Scene, rays: &[Ray]) -> usize {
    let engines = Engines::new(scene);
    let truth = truth(scene, rays);
    for (engine, answers) in [("cpu", Some(engines.on_cpu(rays))), ("device", engines.on_device(rays))] {
        let answers = answers.expect("the scene is plain");
        for (i, Truth { hit, count }) in truth.iter().enumerate() {
            let same = answers.hits[i].same_bits(hit) && answers.counts[i] == *count;
            assert!(
                same,
                "{engine}, {what}: {:?}\n{:?}, {}\n{hit:?}, {count}",
                rays[i], answers.hits[i], answers.counts[i]
            );
        }
    }
    truth.iter().filter(|truth| truth.hit.is_hit()).count()
}

/// Radius 1, at 1e1 to 1e7, within 1e-3 of the rim on either side.
#[test]
fn far_spheres_are_right_at_the_rim() {
    let mut numbers = Numbers::new(21);
    let count = rays(20_000, 1_000_000);
    for power in 1..=7 {
        let distance = 10.0_f32.powi(power);
        for axis in 0..3 {
            let turned = |p: Vec3| Vec3::from([p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]]);
            let center = turned(Vec3::new(distance, 0.0, 0.0));
            let scene =
                Scene::new(vec![Geometry::Spheres(vec![Sphere { center, radius: 1.0 }])]).expect("a valid scene");
            let rays: Vec<Ray> = (0..count / 3 + 1)
                .map(|i| {
                    let (sin, cos) = (numbers.next() * std::f32::consts::TAU).sin_cos();
                    // From a thousandth down to a rounding away from the rim.
                    let near = 0.5_f32.powi(i32::try_from(numbers.below(15)).expect("small"));
                    let rim = 1.0 + 1e-3 * near * (2.0 * numbers.next() - 1.0);
                    let start = turned(Vec3::new(0.0, rim * sin, rim * cos));
                    // Straight along the axis, or slightly inclined and as much aside.
                    let slope =
                        if i % 2 == 0 { Vec3::ZERO } else { turned(Vec3::new(0.0, cos, -sin)) * 0.02 / distance };
                    Ray::new(start, turned(Vec3::X) + slope)
                })
                .collect();
            let hits = compare(&format!("at {distance:e}"), &scene, &rays);
            assert!(hits > rays.len() / 4 && hits < rays.len() * 3 / 4, "{hits} hits do not test a rim");
        }
        println!("radius 1 at {distance:e}: {} rays within 1e-3 of the rim, 0 wrong", (count / 3 + 1) * 3);
    }
}

/// A sphere of radius 1e6 whose top the eye is a thousandth above: t is correctly rounded, 0.5 ULP at most.
#[test]
fn the_ground_is_right_under_the_eye() {
    let mut numbers = Numbers::new(22);
    let ground = Sphere { center: Vec3::new(0.0, -1e6, 0.0), radius: 1e6 };
    let scene = Scene::new(vec![Geometry::Spheres(vec![ground])]).expect("a valid scene");
    let rays: Vec<Ray> = (0..rays(20_000, 1_000_000))
        .map(|_| {
            let mut next = || 2.0 * numbers.next() - 1.0;
            let (x, z) = (next(), next());
            let down = next().abs().powi(4) + 1e-6;
            Ray::new(Vec3::new(0.0, 1e-3, 0.0), Vec3::new(x, -down, z))
        })
        .collect();
    let hits = compare("the ground", &scene, &rays);
    println!("ground of radius 1e6, eye 1e-3 above: {} rays, {hits} hits, 0 wrong, t within 0.5 ULP", rays.len());
    assert!(hits > rays.len() / 2);
}
