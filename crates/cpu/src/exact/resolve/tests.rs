use rayproof_scene::random::Random;

use super::*;

/// Whole numbers over 8 from -2 to 2.
fn numbers(count: usize) -> impl Iterator<Item = f64> {
    let mut random = Random::new(3, 0);
    std::iter::repeat_with(move || f64::from(u32::try_from(random.below(32)).expect("5 bits")) / 8.0 - 2.0).take(count)
}

/// Rays and shapes of small whole numbers: much meets exactly.
fn cases() -> Vec<(ExactRay, Shape, Shape)> {
    let all: Vec<f64> = numbers(30_000).collect();
    let point = |at: &[f64]| [at[0], at[1], at[2]];
    all.chunks_exact(30)
        .filter(|n| point(&n[3..]) != [0.0; 3])
        .map(|n| {
            let ray = ExactRay { origin: point(n), direction: point(&n[3..]), t_min: 0.0, t_max: n[6].abs() * 4.0 };
            let triangle = Shape::Triangle([point(&n[7..]), point(&n[10..]), point(&n[13..])]);
            let sphere = Shape::Sphere { center: point(&n[16..]), radius: n[19].abs() };
            let other = Shape::Triangle([point(&n[20..]), point(&n[23..]), point(&n[26..])]);
            (ray, triangle, if n[29] < 0.0 { sphere } else { other })
        })
        .collect()
}

#[test]
fn many_bits_say_what_128_say() {
    let (mut hits, mut rounded) = (0, 0);
    for (ray, a, b) in cases() {
        for shape in [&a, &b] {
            let narrow = first::<Narrow>(&ray, shape).map(|found| found.is_some());
            let wide = first::<BigInt>(&ray, shape).map(|found| found.is_some());
            assert_eq!(narrow, wide, "{ray:?} {shape:?}");
            assert_eq!(count::<Narrow>(&ray, shape), count::<BigInt>(&ray, shape));
            if wide == Some(true) {
                hits += 1;
                let exactly = round_all::<BigInt>(&ray, shape, 0, [0.0; 3]);
                assert_eq!(round_all::<BigInt>(&ray, shape, 0, [0.25; 3]), exactly, "whatever the guess");
                // Middles between two numbers have many bits.
                let narrow = round_all::<Narrow>(&ray, shape, 0, [0.25; 3]);
                assert!(narrow.is_none() || narrow == exactly, "{narrow:?} {exactly:?}");
                rounded += usize::from(narrow.is_some());
            }
        }
        assert_eq!(order::<Narrow>(&ray, &a, &b), order::<BigInt>(&ray, &a, &b));
    }
    assert!(hits > 100 && rounded > 10, "{hits} hits, {rounded} rounded in 128 bits");
}

#[test]
fn what_128_bits_cannot_hold_is_told() {
    let far = ExactRay { origin: [1e30, 1.0, 1e-30], direction: [-1e30, 3.0, 1e-30], t_min: 0.0, t_max: f64::INFINITY };
    let sphere = Shape::Sphere { center: [0.0; 3], radius: 7.0 };
    assert!(first::<Narrow>(&far, &sphere).is_none());
    assert!(is_hit(&far, &sphere));
}

#[test]
fn roots_are_compared_exactly() {
    // Unit spheres at 3 and at 3 + 2^-60: the near roots are 2 and 2 + 2^-60, as a plane at 2 and a farther one.
    let ray = ExactRay { origin: [0.0; 3], direction: [0.0, 0.0, 1.0], t_min: 0.0, t_max: f64::INFINITY };
    let sphere = |z| Shape::Sphere { center: [0.0, 0.0, z], radius: 1.0 };
    let plane = |z| Shape::Triangle([[-1.0, -1.0, z], [3.0, -1.0, z], [-1.0, 3.0, z]]);
    assert_eq!(compare(&ray, &sphere(3.0), &plane(2.0)), Equal);
    assert_eq!(compare(&ray, &sphere(3.0), &plane(2.0_f64.next_up())), Less);
    assert_eq!(compare(&ray, &plane(2.0_f64.next_down()), &sphere(3.0)), Less);
    // Irrational: (3 - sqrt 2) against itself scaled, and against a sphere a little farther.
    let off = |x: f64, z: f64| Shape::Sphere { center: [x, 0.0, z], radius: 1.5 };
    assert_eq!(compare(&ray, &off(0.5, 3.0), &off(-0.5, 3.0)), Equal);
    assert_eq!(compare(&ray, &off(0.5, 3.0), &off(0.5_f64.next_up(), 3.0)), Less);
}

#[test]
fn a_shared_corner_is_crossed_once() {
    // Eight triangles around the origin, straight through their common corner and along their common edges.
    let rim = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];
    let corner = |i: usize| [rim[i % 8][0], rim[i % 8][1], 0.0];
    for (x, y) in [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (-0.25, 0.25), (0.0, -0.5)] {
        for direction in [[0.0, 0.0, -1.0], [0.25, 0.0, -1.0], [0.5, -0.25, -1.0]] {
            let ray = ExactRay {
                origin: [x - direction[0], y - direction[1], 1.0],
                direction,
                t_min: 0.0,
                t_max: f64::INFINITY,
            };
            let shapes = (0..8).map(|i| Shape::Triangle([[0.0; 3], corner(i), corner(i + 1)]));
            let [hit, crossed] = shapes.fold([0, 0], |[hit, crossed], shape| {
                [hit + u32::from(is_hit(&ray, &shape)), crossed + crossings(&ray, &shape)]
            });
            assert!(hit >= 2, "the point is shared");
            assert_eq!(crossed, 1, "{x} {y} {direction:?}");
        }
    }
}
