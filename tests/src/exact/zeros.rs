//! Boxes that a ray enters at exactly 0, in the units of the walk: the keys that sort and cull children are zeros beside their
//! slots, which a device that takes subnormals for 0 could not tell apart.

use glam::Vec3;
use rayproof::scene::{Geometry, Mesh, Ray, Scene};

use super::{Engines, Truth, truth};
use crate::scenes::Numbers;

/// Triangles from the plane x = 0, where their boxes begin, to x = 1: all of them across the x axis, each at another place.
fn fans(numbers: &mut Numbers, count: usize) -> Scene {
    let mut corners = Vec::new();
    for _ in 0..count {
        let slope = 0.9 * numbers.next();
        corners.extend([[0.0, -1.0, -1.0], [slope, 1.0, -1.0], [1.0, numbers.next() - 0.5, 1.0]]);
    }
    let triangles = (0..u32::try_from(count).expect("few")).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Scene::new(vec![Geometry::Mesh(Mesh::new(corners, triangles))]).expect("a valid scene")
}

#[test]
fn children_that_are_entered_at_zero_are_all_visited() {
    let mut numbers = Numbers::new(31);
    // The walk moves where a box is entered by 2^-40 of the scene's size, 1, after it took 2^-19 of it away: this becomes 0.
    let start = -(2.0_f32.powi(-39) * (1.0 + 2.0_f32.powi(-19)));
    let mut hits = 0;
    for count in [4, 7, 16, 40] {
        let scene = fans(&mut numbers, count);
        let mut near = || 0.1 * numbers.next() - 0.05;
        let rays: Vec<Ray> = (0..500).map(|_| Ray::new(Vec3::new(start, near(), near()), Vec3::X)).collect();
        let engines = Engines::new(&scene);
        let device = engines.on_device(&rays).expect("the scene is plain");
        for (i, Truth { hit, count }) in truth(&scene, &rays).iter().enumerate() {
            assert!(device.hits[i].same_bits(hit), "{:?}\n{:?}\n{hit:?}", rays[i], device.hits[i]);
            assert_eq!(device.counts[i], *count, "{:?}", rays[i]);
            hits += usize::from(hit.is_hit());
        }
    }
    println!("{hits} rays into boxes that are entered at 0, 0 wrong");
    assert!(hits > 1500, "{hits}");
}
