//! The triangles of a polygon.
//!
//! A polygon of n corners becomes n - 2 triangles, each of three of its corners, in the winding of the polygon. They are found in
//! the coordinate plane that its normal by Newell's method faces most, by exact signs (Shewchuk's adaptive predicate), so that
//! none covers a notch:
//!
//! * where the triangles `(0, i, i + 1)` all turn the same way, they are the answer, in this order: a convex polygon's, and that
//!   of any other that its first corner sees whole;
//! * otherwise ears are clipped: a corner goes whose triangle turns the polygon's way and meets no other edge, or, where there is
//!   none, a corner on a line; before both the tips of spikes and repeated corners, whose triangles have no area in the plane;
//! * where the triangles found so overlap, or none can be found, the polygon crosses itself: it has no inside that all agree
//!   on, is fanned from its first corner, and is told.
//!
//! Why that is right: cutting off a corner leaves the sum of the winding numbers of all triangles what the polygon's is. Where
//! they all turn one way, a point lies in as many of them as the polygon winds around it; where none overlaps another, that is
//! once inside and never outside.

use glam::{DVec2, DVec3, Vec3};
use robust::{Coord, orient2d};

/// Whether a polygon's triangles are its inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub(super) enum Inside {
    /// They are.
    Covered,
    /// It crosses itself: they are its fan.
    Crossed,
}

/// What is kept from one polygon to the next, so that nothing is allocated for each.
#[derive(Default)]
pub(super) struct Polygons {
    points: Vec<DVec2>,
    left: Vec<usize>,
    ears: Vec<[usize; 3]>,
}

impl Polygons {
    /// Appends the triangles of the polygon `corners`, numbers of `vertices`, to `triangles`: none for fewer than three corners.
    /// A corner that is no vertex counts as the origin; whoever reads it tells it.
    pub(super) fn triangulate(&mut self, corners: &[u32], vertices: &[Vec3], triangles: &mut Vec<[u32; 3]>) -> Inside {
        if corners.len() <= 3 {
            triangles.extend(fan(corners));
            return Inside::Covered;
        }
        let at = |corner: u32| vertices.get(corner as usize).copied().unwrap_or_default().as_dvec3();
        project(corners.iter().map(|&corner| at(corner)), &mut self.points);
        if self.inside() == Inside::Crossed {
            triangles.extend(fan(corners));
            return Inside::Crossed;
        }
        triangles.extend(self.ears.iter().map(|ear| ear.map(|i| corners[i])));
        Inside::Covered
    }

    /// Finds the ears of the points, if they have an inside.
    fn inside(&mut self) -> Inside {
        const WAYS: [f64; 2] = [1.0, -1.0];
        let Self { points, left, ears } = self;
        let fans = WAYS.into_iter().any(|way| match fan_ears(points, way, ears) {
            Some(Fan::Convex) => true,
            Some(Fan::Other) => !overlap(points, way, ears),
            None => false,
        });
        if fans || WAYS.into_iter().any(|way| clip(points, way, left, ears) && !overlap(points, way, ears)) {
            Inside::Covered
        } else {
            Inside::Crossed
        }
    }
}

/// What kind of polygon a fan covers, as far as it turns one way.
enum Fan {
    Convex,
    Other,
}

/// The triangles from the first corner, in order.
fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let first = corners.first().copied().unwrap_or_default();
    corners.windows(2).skip(1).map(move |edge| [first, edge[0], edge[1]])
}

/// The corners in the coordinate plane that the normal faces most. Which plane it is need not be certain: signs are exact in all.
fn project(corners: impl Iterator<Item = DVec3> + Clone, points: &mut Vec<DVec2>) {
    let first = corners.clone().next().unwrap_or_default();
    // Newell's normal: twice the areas of the shadows on the three planes.
    let edges = corners.clone().zip(corners.clone().skip(1));
    let normal = edges.fold(DVec3::ZERO, |sum, (a, b)| sum + (a - first).cross(b - first)).abs();
    points.clear();
    if normal.x > normal.y && normal.x > normal.z {
        points.extend(corners.map(|c| DVec2::new(c.y, c.z)));
    } else if normal.y > normal.z {
        points.extend(corners.map(|c| DVec2::new(c.z, c.x)));
    } else {
        points.extend(corners.map(|c| DVec2::new(c.x, c.y)));
    }
}

/// Positive where `a, b, c` turn left, negative where they turn right, 0 where they lie on a line: exactly.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// The fan of a polygon, if all its triangles turn the `way` (1: left, -1: right), and whether all corners do, too.
fn fan_ears(points: &[DVec2], way: f64, ears: &mut Vec<[usize; 3]>) -> Option<Fan> {
    let n = points.len();
    let turns = |[a, b, c]: [usize; 3]| turn(points[a], points[b], points[c]) * way >= 0.0;
    ears.clear();
    ears.extend((1..n - 1).map(|i| [0, i, i + 1]));
    if !ears.iter().copied().all(turns) {
        return None;
    }
    // Once around, a convex polygon goes up and down the plane's points in order once; else it goes around more than once.
    let ahead = |i: usize| {
        let step = points[(i + 1) % n] - points[i];
        (step != DVec2::ZERO).then_some(step.x > 0.0 || (step.x == 0.0 && step.y > 0.0))
    };
    let ways: Vec<bool> = (0..n).filter_map(ahead).collect();
    let changes = (0..ways.len()).filter(|&i| ways[i] != ways[(i + 1) % ways.len()]).count();
    let convex = changes <= 2 && (0..n).map(|i| [i, (i + 1) % n, (i + 2) % n]).all(turns);
    Some(if convex { Fan::Convex } else { Fan::Other })
}

/// Clips ears that turn the `way` (1: left, -1: right) until a triangle is left; false where there is none to clip.
fn clip(points: &[DVec2], way: f64, left: &mut Vec<usize>, ears: &mut Vec<[usize; 3]>) -> bool {
    ears.clear();
    left.clear();
    left.extend(0..points.len());
    let mut at = 1;
    while left.len() > 3 {
        let n = left.len();
        let order = (0..n).map(|k| (at + k) % n);
        // The tips of spikes go first: beside one, a triangle may turn the right way and lie outside.
        let found = order.clone().find(|&i| is_tip(points, left, i));
        let found = found.or_else(|| order.clone().find(|&i| is_ear(points, left, i, way)));
        let found = found.or_else(|| order.clone().find(|&i| turn_at(points, left, i) == 0.0));
        let Some(i) = found else { return false };
        ears.push(around(left, i));
        left.remove(i);
        // From the same corner on: the next of a fan.
        at = i % left.len();
    }
    ears.push([left[0], left[1], left[2]]);
    turn_at(points, left, 1) * way >= 0.0
}

/// A corner between its neighbours.
fn around(left: &[usize], i: usize) -> [usize; 3] {
    let n = left.len();
    [left[(i + n - 1) % n], left[i], left[(i + 1) % n]]
}

fn turn_at(points: &[DVec2], left: &[usize], i: usize) -> f64 {
    let [a, b, c] = around(left, i).map(|k| points[k]);
    turn(a, b, c)
}

/// Whether a corner goes back the way that it came, or nowhere.
fn is_tip(points: &[DVec2], left: &[usize], i: usize) -> bool {
    let [a, b, c] = around(left, i).map(|k| points[k]);
    // On a line, the order along it is that of either coordinate.
    let between = |axis: fn(DVec2) -> f64| {
        let [a, b, c] = [a, b, c].map(axis);
        (a < b && b < c) || (a > b && b > c)
    };
    !between(|p| p.x) && !between(|p| p.y) && turn(a, b, c) == 0.0
}

/// Whether the triangle at a corner turns the right way and no edge enters it.
fn is_ear(points: &[DVec2], left: &[usize], i: usize, way: f64) -> bool {
    if turn_at(points, left, i) * way <= 0.0 {
        return false;
    }
    let triangle = leftward(around(left, i).map(|k| points[k]), way);
    let n = left.len();
    // The edges but those two that meet at the corner: from the next corner around to the one before.
    (1..n - 1).all(|k| !enters([left[(i + k) % n], left[(i + k + 1) % n]].map(|k| points[k]), triangle))
}

/// A triangle that turns the `way`, turned left.
fn leftward([a, b, c]: [DVec2; 3], way: f64) -> [DVec2; 3] {
    if way < 0.0 { [c, b, a] } else { [a, b, c] }
}

fn edges(&[a, b, c]: &[DVec2; 3]) -> [[DVec2; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Whether a segment has a point within a triangle that turns left, its border apart: two convex figures are apart where an edge's
/// line parts them.
fn enters([c, d]: [DVec2; 2], triangle: [DVec2; 3]) -> bool {
    let [p, q, r] = triangle;
    let (low, high) = (c.min(d), c.max(d));
    if low.cmpge(p.max(q).max(r)).any() || high.cmple(p.min(q).min(r)).any() {
        return false;
    }
    if edges(&triangle).into_iter().any(|[a, b]| turn(a, b, c) <= 0.0 && turn(a, b, d) <= 0.0) {
        return false;
    }
    let sides = triangle.map(|corner| turn(c, d, corner));
    c == d || (sides.iter().any(|&side| side > 0.0) && sides.iter().any(|&side| side < 0.0))
}

/// Whether the insides of two of the triangles, which turn the `way`, meet.
fn overlap(points: &[DVec2], way: f64, ears: &[[usize; 3]]) -> bool {
    let mut triangles: Vec<_> = ears.iter().map(|ear| leftward(ear.map(|i| points[i]), way)).collect();
    triangles.retain(|&[a, b, c]| turn(a, b, c) > 0.0);
    let low = |t: &[DVec2; 3]| t[0].min(t[1]).min(t[2]);
    let high = |t: &[DVec2; 3]| t[0].max(t[1]).max(t[2]);
    // In order of where they begin, so that only neighbours are compared.
    triangles.sort_by(|s, t| low(s).x.total_cmp(&low(t).x));
    triangles.iter().enumerate().any(|(i, s)| {
        let near = triangles[i + 1..].iter().take_while(|t| low(t).x < high(s).x);
        near.filter(|t| low(t).y < high(s).y && low(s).y < high(t).y).any(|t| {
            let parts = |s: &[DVec2; 3], t: &[DVec2; 3]| {
                edges(s).into_iter().any(|[a, b]| t.iter().all(|&corner| turn(a, b, corner) <= 0.0))
            };
            !parts(s, t) && !parts(t, s)
        })
    })
}
