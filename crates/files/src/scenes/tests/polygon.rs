//! Polygons against exact points in polygons: integers, so that the test's own arithmetic is exact.

use glam::Vec3;
use proptest::prelude::*;

use super::config;
use crate::scenes::polygon::{Inside, Polygons};

type Point = [i64; 2];

/// Twice the area of a triangle, with its sign.
fn turn([a, b, c]: [Point; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// How often a polygon winds around a point; none where the point lies on an edge's line between its ends' heights.
fn winding(polygon: &[Point], p: Point) -> Option<i64> {
    let mut sum = 0;
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let side = turn([a, b, p]);
        if side == 0 && (a[1].min(b[1])..=a[1].max(b[1])).contains(&p[1]) {
            return None;
        }
        sum += i64::from(a[1] <= p[1] && b[1] > p[1] && side > 0) - i64::from(b[1] <= p[1] && a[1] > p[1] && side < 0);
    }
    Some(sum)
}

/// A polygon of the test in one of the six ways of laying a plane, tilted, and its triangles.
fn triangulated(polygon: &[Point], plane: usize) -> (Inside, Vec<[Point; 3]>) {
    let vertices: Vec<Vec3> = polygon
        .iter()
        .map(|&[x, y]| {
            let (x, y) = (x as f32, y as f32);
            let tilt = 0.25 * x - 0.5 * y;
            [[x, y, tilt], [y, x, tilt], [tilt, x, y], [tilt, y, x], [x, tilt, y], [y, tilt, x]][plane].into()
        })
        .collect();
    let corners: Vec<u32> = (0..).take(polygon.len()).collect();
    let mut triangles = Vec::new();
    let inside = Polygons::default().triangulate(&corners, &vertices, &mut triangles);
    (inside, triangles.iter().map(|t| t.map(|corner| polygon[corner as usize])).collect())
}

/// How many of the triangles hold a point; none where it lies on the border of one.
fn covered(triangles: &[[Point; 3]], p: Point) -> Option<i64> {
    let mut sum = 0;
    for &[a, b, c] in triangles {
        let sides = [[a, b, p], [b, c, p], [c, a, p]].map(turn);
        if sides.iter().all(|&side| side > 0) || sides.iter().all(|&side| side < 0) {
            sum += 1;
        } else if sides.iter().all(|&side| side >= 0) || sides.iter().all(|&side| side <= 0) {
            return None;
        }
    }
    Some(sum)
}

/// Every rotation and both windings in every plane, points all over: what is covered is the inside. Returns the points compared.
fn assert_inside(name: &str, polygon: &[Point]) -> usize {
    let mut compared = 0;
    let low = [0, 1].map(|axis| polygon.iter().map(|p| p[axis]).min().expect("corners") - 3);
    let high = [0, 1].map(|axis| polygon.iter().map(|p| p[axis]).max().expect("corners") + 3);
    let step = [0, 1].map(|axis| usize::try_from((high[axis] - low[axis]) / 41).unwrap().max(1));
    for rotation in 0..polygon.len() {
        for backwards in [false, true] {
            let mut turned = polygon.to_vec();
            turned.rotate_left(rotation);
            if backwards {
                turned.reverse();
            }
            let (inside, triangles) = triangulated(&turned, rotation % 6);
            assert_eq!(inside, Inside::Covered, "{name} from corner {rotation}, backwards {backwards}");
            assert_eq!(triangles.len(), polygon.len() - 2, "{name} from corner {rotation}");
            for x in (low[0]..high[0]).step_by(step[0]) {
                for y in (low[1]..high[1]).step_by(step[1]) {
                    let (Some(known), Some(found)) = (winding(&turned, [x, y]), covered(&triangles, [x, y])) else {
                        continue;
                    };
                    assert_eq!(
                        found,
                        known.abs(),
                        "{name} from corner {rotation}, backwards {backwards}, at ({x}, {y})"
                    );
                    compared += 1;
                }
            }
        }
    }
    compared
}

/// Corners on a ray each, at these distances: a polygon that its centre sees whole.
#[expect(clippy::cast_possible_truncation, reason = "to whole numbers near the rays")]
fn star(distances: &[i64]) -> Vec<Point> {
    let n = distances.len() as f64;
    let corner = |(i, &d): (usize, &i64)| {
        let angle = i as f64 * std::f64::consts::TAU / n;
        [angle.cos(), angle.sin()].map(|x| (x * d as f64) as i64)
    };
    distances.iter().enumerate().map(corner).collect()
}

fn comb(teeth: i64) -> Vec<Point> {
    let mut polygon = vec![[0, -50], [100 * teeth, -50]];
    polygon.extend((0..teeth).rev().flat_map(|i| [[100 * i + 70, 500], [100 * i + 30, 500], [100 * i + 10, 10]]));
    polygon
}

/// A band along a square spiral.
fn spiral(turns: i64) -> Vec<Point> {
    let corner = |i: i64, inset: i64| {
        let r = 40 * i + 60 - inset;
        [[r, -r + 40], [r, r], [-r, r], [-r, -r]][(i % 4) as usize]
    };
    let out = (0..4 * turns).map(|i| corner(i, 0));
    out.chain((0..4 * turns).rev().map(|i| corner(i, 25))).collect()
}

#[test]
fn what_is_covered_is_the_inside() {
    let mut compared = 0;
    let mut polygons = 0;
    let mut shapes = vec![
        ("dart", vec![[0, 0], [400, 0], [100, 100], [0, 400]]),
        ("the letter L", vec![[0, 0], [300, 0], [300, 100], [100, 100], [100, 300], [0, 300]]),
        ("square with corners on its sides", vec![[0, 0], [50, 0], [100, 0], [100, 70], [100, 100], [0, 100], [0, 30]]),
        ("dart with corners on its sides", vec![[0, 0], [200, 0], [400, 0], [250, 50], [100, 100], [0, 400], [0, 200]]),
        ("repeated corners", vec![[0, 0], [400, 0], [400, 0], [100, 100], [100, 100], [100, 100], [0, 400]]),
        ("spike outwards", vec![[0, 0], [200, 0], [200, -300], [200, 0], [400, 0], [100, 100], [0, 400]]),
        ("spike inwards", vec![[0, 0], [100, 0], [100, 90], [100, 0], [400, 0], [100, 100], [0, 400]]),
        // A square with a square hole, to which a bridge leads: four of its corners lie at two places.
        (
            "keyhole",
            vec![
                [0, 0],
                [300, 0],
                [300, 300],
                [0, 300],
                [0, 0],
                [100, 100],
                [100, 200],
                [200, 200],
                [200, 100],
                [100, 100],
            ],
        ),
        (
            "two squares at a corner",
            vec![[0, 0], [100, 0], [100, 100], [200, 100], [200, 200], [100, 200], [100, 100], [0, 100]],
        ),
    ];
    shapes.push(("comb", comb(9)));
    shapes.push(("star", star(&[500, 150, 480, 90, 510, 200, 490, 30, 500, 160])));
    shapes.push(("spiral", spiral(3)));
    for (name, polygon) in &shapes {
        compared += assert_inside(name, polygon);
        polygons += 2 * polygon.len();
    }
    println!("{} shapes, {polygons} polygons, {compared} points, 0 wrong", shapes.len());
    assert!(compared > 100_000);
}

#[test]
fn convex_polygons_are_fans_and_crossed_ones_are_told() {
    let fan = |n: usize, polygon: &[Point]| -> Vec<[Point; 3]> {
        (1..n - 1).map(|i| [polygon[0], polygon[i], polygon[i + 1]]).collect()
    };
    for n in 3..30 {
        let mut polygon = star(&vec![1000; n]);
        for _ in 0..2 * n {
            polygon.rotate_left(1);
            if polygon[0][1] == 0 {
                polygon.reverse();
            }
            assert_eq!(triangulated(&polygon, n % 6), (Inside::Covered, fan(n, &polygon)), "{n} corners");
        }
    }
    let crossed = [
        ("hourglass", vec![[0, 0], [100, 100], [100, 0], [0, 100]]),
        ("pentagram", (0..5).map(|i| star(&[1000; 5])[2 * i % 5]).collect()),
        ("hourglass through a corner", vec![[0, 0], [50, 50], [100, 100], [100, 0], [50, 50], [0, 100]]),
        // It winds twice around its inner loop, which it enters and leaves at one corner.
        (
            "loop within a loop",
            vec![[0, 0], [300, 0], [200, 200], [100, 100], [200, 50], [300, 0], [300, 400], [0, 400]],
        ),
    ];
    for (name, polygon) in crossed {
        assert_eq!(triangulated(&polygon, 0), (Inside::Crossed, fan(polygon.len(), &polygon)), "{name}");
    }
    let nowhere = vec![[0, 0], [1, 1], [2, 2], [1, 1], [3, 3]];
    assert_eq!(triangulated(&nowhere, 0), (Inside::Covered, fan(5, &nowhere)), "on a line");
}

proptest! {
    #![proptest_config(config(2000))]

    /// Any polygon at all: covered as often as it winds if it is called whole, else its fan; never more or fewer triangles.
    #[test]
    fn any_polygon_is_covered_or_told(polygon in prop::collection::vec([-6_i64..6, -6_i64..6], 3..12), plane in 0..6_usize) {
        let polygon: Vec<Point> = polygon.iter().map(|p| p.map(|x| 10 * x)).collect();
        let (inside, triangles) = triangulated(&polygon, plane);
        prop_assert_eq!(triangles.len(), polygon.len() - 2);
        let mut crossed = false;
        for x in (-61..62).step_by(7) {
            for y in (-63..62).step_by(7) {
                let Some(known) = winding(&polygon, [x, y]) else { continue };
                crossed |= known.abs() > 1;
                if let (Inside::Covered, Some(found)) = (inside, covered(&triangles, [x, y])) {
                    prop_assert_eq!(found, known.abs(), "at ({}, {})", x, y);
                }
            }
        }
        prop_assert!(inside == Inside::Crossed || !crossed);
    }

    /// Polygons that their centre sees whole do not cross themselves, and are covered.
    #[test]
    fn stars_are_covered(distances in prop::collection::vec(20_i64..1000, 3..40), plane in 0..6_usize) {
        let polygon = star(&distances);
        let (inside, triangles) = triangulated(&polygon, plane);
        // A star of three or four may not hold its centre, and with few corners one may lie beyond another's angle.
        prop_assume!(distances.len() > 4);
        prop_assert_eq!(inside, Inside::Covered);
        for x in (-1001..1002).step_by(143) {
            for y in (-1003..1002).step_by(143) {
                if let (Some(known), Some(found)) = (winding(&polygon, [x, y]), covered(&triangles, [x, y])) {
                    prop_assert_eq!(found, known.abs(), "at ({}, {})", x, y);
                }
            }
        }
    }
}
