#![expect(clippy::print_stdout, reason = "tests tell how much they compared")]

use glam::Vec3;
use rayproof_scene::{Geometry, Mesh, Sphere, Triangle};

use super::*;
use crate::families::{self, Draw};
use crate::root::Root;
use crate::sphere::Roots;
use crate::triangle::PlanePoint;

const SEED: u64 = 20_261_125;

#[test]
fn both_oracles_agree_on_all_families() {
    let mut all = Agreement::default();
    for family in families::all() {
        let mut own = Agreement::default();
        for case in family.cases(SEED, 600) {
            own = own.with(compare(&case.scene, &case.rays));
        }
        println!("family {:>2}: {} compared, {} beyond", family.number, own.compared, own.beyond);
        assert_eq!(own.disagreed, 0, "family {}:\n{}", family.number, own.first.unwrap_or_default());
        assert!(own.compared > 0, "family {}: nothing was compared", family.number);
        all = all.with(own);
    }
    println!("{} rays compared, {} beyond the range of expansions", all.compared, all.beyond);
    assert!(all.beyond * 20 < all.compared, "{} of {} are beyond", all.beyond, all.compared);
}

#[test]
fn a_damaged_answer_is_a_disagreement() {
    let case = &families::all()[20].cases(SEED, 64)[0];
    let (first, second) = (Oracle::new(&case.scene), SecondOracle::new(&case.scene));
    for ray in &case.rays {
        let exact = first.closest(ray).expect("is aimed at a vertex").to_hit();
        let (count, answer) = (first.count(ray), second.answer(ray).expect("within range"));
        let judged = |hit: FlatHit, count: u32| judge(ray, hit, count, Some(answer));
        assert_eq!((judged(exact, count).disagreed, judged(exact, count).compared), (0, 1));
        let damaged = [
            FlatHit { t: exact.t.next_up(), ..exact },
            FlatHit { u: exact.u + 1e-7, ..exact },
            FlatHit { v: exact.v + 1e-7, ..exact },
            FlatHit { primitive: exact.primitive + 1, ..exact },
            FlatHit::MISS,
        ];
        for hit in damaged {
            let found = judged(hit, count);
            assert!(found.disagreed == 1 && found.first.is_some(), "{hit:?}");
        }
        assert_eq!(judged(exact, count + 1).disagreed, 1);
    }
}

/// Places that lie near one another, and on one another: small whole numbers.
#[test]
fn places_compare_as_the_rationals_do() {
    let mut draw = Draw::new(SEED, 200, 0);
    #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
    let mut whole = |n: f64| (draw.range(-n, n + 1.0).floor()) as f32;
    let (mut compared, mut equal) = (0, 0);
    for _ in 0..2_000 {
        let mut point = |n: f64| Vec3::new(whole(n), whole(n), whole(n));
        let ray = Ray::new(point(2.0), point(2.0));
        let spheres = [0; 2].map(|_| Sphere { center: point(2.0), radius: point(3.0).x.abs() });
        let triangle = Triangle { a: point(2.0), b: point(2.0), c: point(2.0) };
        if ray.fault().is_some() {
            continue;
        }
        let (line, exact_line) = (Line::new(&ray), crate::rational::Line::new(&ray));
        let mut places: Vec<(Parameter, Root)> = Vec::new();
        for sphere in &spheres {
            let exact = match Roots::new(&exact_line, sphere) {
                Roots::None => vec![],
                Roots::Double(t) => vec![t.clone(), t],
                Roots::Two(roots) => roots.into(),
            };
            let found = roots(&line, sphere).expect("small numbers");
            assert_eq!(found.len(), exact.len(), "{ray:?} {sphere:?}");
            places.extend(found.into_iter().zip(exact));
        }
        let plane = PlaneHit::new(&line, &triangle).expect("small numbers");
        let exact = PlanePoint::new(&exact_line, &triangle);
        assert_eq!(plane.is_some(), exact.is_some());
        places.extend(plane.into_iter().map(|p| p.t).zip(exact.map(|p| p.t())));
        for (a, exact_a) in &places {
            assert_eq!(a.nearest(), Some(exact_a.to_f32()));
            for (b, exact_b) in &places {
                assert_eq!(a.order_of(b), Some(exact_a.cmp(exact_b)), "{ray:?} {spheres:?} {triangle:?}");
                compared += 1;
                equal += usize::from(exact_a == exact_b);
            }
        }
    }
    assert!(compared > 10_000 && equal > compared / 4, "{compared}, {equal} equal");
}

/// A scene of small whole numbers, where lines meet edges, vertices, tangents and one another's ties, and planes hold the ray:
/// triangles, spheres or both. Every axis is scaled by a power of two, its own where there are only triangles.
fn small_numbers(number: u64) -> (Scene, Vec<Ray>) {
    let mut draw = Draw::new(SEED, 201, number);
    let (spread, kind) = ([0.0, 10.0, 40.0, 125.0][draw.below(4)], draw.below(3));
    #[expect(clippy::cast_possible_truncation, reason = "powers of two")]
    let powers = [0; 3].map(|_| draw.range(-spread, spread).round().exp2() as f32);
    let scale = if kind == 0 { Vec3::from(powers) } else { Vec3::splat(powers[0]) };
    let triangles = (0..10).map(|_| [0; 3].map(|_| [0, 1, 2, 3, 4, 5][draw.below(6)])).collect();
    #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
    let mut whole = |n: f64| draw.range(-n, n + 1.0).floor() as f32;
    let mut point = |n: f64| Vec3::new(whole(n), whole(n), whole(n));
    let mesh = Geometry::Mesh(Mesh { vertices: (0..6).map(|_| point(2.0) * scale).collect(), triangles });
    let sphere = |_| Sphere { center: point(2.0) * scale, radius: (point(3.0) * scale).x.abs() };
    let spheres = Geometry::Spheres((0..6).map(sphere).collect());
    let ray = |_| {
        let ends = point(4.0);
        let t_max = if ends.z > 0.0 { f32::INFINITY } else { ends.y };
        Ray { t_min: ends.x, t_max, ..Ray::new(point(3.0) * scale, point(2.0) * scale) }
    };
    let rays = (0..24).map(ray).collect();
    let geometries = match kind {
        0 => vec![mesh],
        1 => vec![spheres],
        _ => vec![mesh, spheres],
    };
    (Scene::new(geometries).expect("a valid scene"), rays)
}

#[test]
fn both_oracles_agree_on_small_whole_numbers_of_any_scale() {
    let (mut all, mut hits) = (Agreement::default(), 0);
    for number in 0..2_000 {
        let (scene, rays) = small_numbers(number);
        let second = SecondOracle::new(&scene);
        hits += rays.iter().filter_map(|ray| second.answer(ray)).filter(|answer| answer.hit != FlatHit::MISS).count();
        all = all.with(compare(&scene, &rays));
    }
    println!("{} compared, {hits} hit, {} beyond", all.compared, all.beyond);
    assert_eq!(all.disagreed, 0, "{}", all.first.unwrap_or_default());
    assert!(all.compared > 45_000 && hits > 10_000, "{all:?}, {hits} hit");
}
