//! Every primitive is found once, inside the boxes above it.

use glam::Vec3;
use rayproof_scene::random::Random;
use rayproof_scene::{Geometry, Kind, Mesh, Scene, Sphere};

use crate::node::{Child, EMPTY};
use crate::topology::DEEPEST;
use crate::{Bvh, Scaling};

/// A scene of both kinds, from a fixed seed, with duplicates and one far larger than the rest.
fn scene(triangles: usize, spheres: usize) -> Scene {
    let mut random = Random::new(11, 0);
    let mut x = || random.single();
    let mut mesh = Mesh::default();
    for i in 0..triangles {
        let at = Vec3::new(x(), x(), x()) * if i % 5 == 0 { 0.0 } else { 10.0 };
        let base = u32::try_from(mesh.vertices.len()).expect("few");
        mesh.vertices.extend([at, at + Vec3::new(x(), x(), 0.0), at + Vec3::new(0.0, x(), x())]);
        mesh.triangles.push([base, base + 1, base + 2]);
    }
    let mut balls: Vec<Sphere> =
        (0..spheres).map(|_| Sphere { center: Vec3::new(x(), x(), x()) * 10.0, radius: x() * 0.1 }).collect();
    if let Some(ball) = balls.first_mut() {
        *ball = Sphere { center: Vec3::new(0.0, -1e6, 0.0), radius: 1e6 };
    }
    Scene::new(vec![Geometry::Mesh(mesh), Geometry::Spheres(balls)]).expect("a valid scene")
}

/// Walks the tree; returns the flat numbers found and checks that each box holds what is under it.
fn walk(bvh: &Bvh) -> Vec<u32> {
    let mut found = Vec::new();
    let everything = [Vec3::NEG_INFINITY, Vec3::INFINITY];
    let mut stack = vec![(0_usize, vec![everything], 0_usize)];
    while let Some((index, above, pushed)) = stack.pop() {
        let node = &bvh.nodes[index];
        let used = node.children.iter().filter(|&&w| w != EMPTY).count();
        let pushed = pushed + used.saturating_sub(1);
        assert!(pushed <= bvh.stack_depth);
        for k in 0..4 {
            let mut inside = above.clone();
            inside.push(node.child_box(k));
            let check = |low: Vec3, high: Vec3| {
                for b in &inside {
                    assert!(b[0].cmple(low).all() && b[1].cmpge(high).all(), "{low} {high} leaves {b:?}");
                }
            };
            match Child::from_word(node.children[k]) {
                Child::Empty => {}
                Child::Node(child) => stack.push((child, inside, pushed)),
                Child::Leaf { kind: Kind::Triangle, first, count } => {
                    for t in &bvh.triangles[first..first + count] {
                        check(t.a.min(t.b).min(t.c), t.a.max(t.b).max(t.c));
                        found.push(t.id);
                    }
                }
                Child::Leaf { kind: Kind::Sphere, first, count } => {
                    for i in first..first + count {
                        let s = bvh.spheres[i];
                        check(s.center - s.radius, s.center + s.radius);
                        found.push(bvh.sphere_ids[i]);
                    }
                }
            }
        }
    }
    found
}

#[test]
fn every_primitive_is_found_once_inside_its_boxes() {
    for (triangles, spheres) in
        [(0, 0), (1, 0), (0, 1), (1, 1), (2, 3), (4, 0), (5, 0), (500, 0), (0, 500), (700, 600), (9000, 7000)]
    {
        let scene = scene(triangles, spheres);
        for scaling in [Scaling::None, Scaling::PowerOfTwo] {
            let bvh = Bvh::new(&scene, scaling).expect("small");
            let mut found = walk(&bvh);
            found.sort_unstable();
            let all: Vec<u32> = (0..u32::try_from(scene.len()).expect("few")).collect();
            assert_eq!(found, all, "{triangles} triangles, {spheres} spheres");
        }
    }
}

/// The tree of a scene, after a look at whether it holds everything.
fn whole(geometry: Geometry) -> Bvh {
    let scene = Scene::new(vec![geometry]).expect("a valid scene");
    let bvh = Bvh::new(&scene, Scaling::None).expect("small");
    assert_eq!(walk(&bvh).len(), scene.len());
    bvh
}

#[test]
fn copies_and_shapes_inside_each_other_make_no_deep_tree() {
    // Triangles whose sizes fall by powers of two, one inside the other.
    let mut nested = Mesh::default();
    for i in 0..120_u32 {
        let s = 2.0_f32.powi(60 - i32::try_from(i).expect("few"));
        nested.vertices.extend([Vec3::ZERO, Vec3::new(s, 0.0, 0.0), Vec3::new(0.0, s, s)]);
        nested.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let copies = Mesh::new([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]; 50_000]);
    let shells = (1..30_000_u16).map(|i| Sphere::new([0.0; 3], f32::from(i))).collect();
    for geometry in [Geometry::Mesh(nested), Geometry::Mesh(copies), Geometry::Spheres(shells)] {
        let bvh = whole(geometry);
        // A node of four leaves three entries behind, and is one level of the binary tree at least.
        assert!(bvh.stack_depth <= 3 * DEEPEST as usize + 3, "{}", bvh.stack_depth);
    }
}

#[test]
fn what_is_large_lies_near_the_root() {
    // A grid of small triangles over a large one: rays that meet its plane should not search the grid first.
    let mut mesh = Mesh::new([[0.0; 3], [100.0, 0.0, 0.0], [0.0, 100.0, 0.0]], vec![[0, 1, 2]]);
    for i in 0..2500_u16 {
        let at = Vec3::new(f32::from(i % 50) * 2.0, f32::from(i / 50) * 2.0, 0.5);
        let first = u32::try_from(mesh.vertices.len()).expect("few");
        mesh.vertices.extend([at, at + Vec3::X, at + Vec3::new(0.0, 1.0, 1.0)]);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    let bvh = whole(Geometry::Mesh(mesh));
    let leaf_of_all = |word| match Child::from_word(word) {
        Child::Leaf { first, count, .. } => bvh.triangles[first..first + count].iter().any(|t| t.id == 0),
        _ => false,
    };
    assert!(bvh.nodes[0].children.into_iter().any(leaf_of_all), "{:?}", bvh.nodes[0]);
}
