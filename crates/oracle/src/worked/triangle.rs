//! A ray and a triangle: the system `[b - a, c - a, -d] [u v t]^T = e - a` by Cramer's rule.

use glam::Vec3;
use rayproof_scene::{Precision, Ray, Triangle};

use super::float::{Float, cross3, dot3, sub};
use super::range::{Place, first_within};
use super::{COLUMNS, Column, Conclusion, Heading, INVALID, System, Value};
use crate::rational::{self, Line, Number, Vector};

/// The quantities.
pub(super) const ROWS: [Heading; 7] = [
    ("det", "|b - a, c - a, -d|"),
    ("det u", "|e - a, c - a, -d|"),
    ("det v", "|b - a, e - a, -d|"),
    ("det t", "|b - a, c - a, e - a|"),
    ("u", "det u / det"),
    ("v", "det v / det"),
    ("t", "det t / det"),
];

/// Why a ray is rejected that no comparison tells anything of.
const NAN: &str = "det, u or v is not a number";

type TriangleColumn = Column<{ ROWS.len() }>;

/// Every precision's system and its column.
pub(super) fn columns(ray: &Ray, triangle: &Triangle) -> ([System; 5], [TriangleColumn; 5]) {
    let worked = COLUMNS.map(|precision| match precision {
        Precision::Textbook => absent(Conclusion::Absent),
        Precision::Classic => by_the_book(ray, triangle),
        Precision::Fast => shifted::<f32>(ray, triangle),
        Precision::Pair | Precision::Double => shifted::<f64>(ray, triangle),
        Precision::Exact => exact(ray, triangle),
    });
    (worked.each_ref().map(|(system, _)| system.clone()), worked.map(|(_, column)| column))
}

fn absent(answer: Conclusion) -> (System, TriangleColumn) {
    (std::array::from_fn(|_| [const { Value::Absent }; 4]), Column::absent(answer))
}

/// The system of these columns.
fn system<T>(columns: [[T; 3]; 4]) -> System
where
    Value: From<T>,
{
    let [[ax, ay, az], [bx, by, bz], [cx, cy, cz], [dx, dy, dz]] = columns.map(|column| column.map(Value::from));
    [[ax, bx, cx, dx], [ay, by, cy, dy], [az, bz, cz, dz]]
}

/// The column of a determinant, the numerators of `u, v, t`, and the quotients where there are any.
fn column<T>(determinants: [T; 4], quotients: Option<[T; 3]>, answer: Conclusion) -> TriangleColumn
where
    Value: From<T>,
{
    let [det, det_u, det_v, det_t] = determinants.map(Value::from);
    let [u, v, t] = quotients.map_or([const { Value::Absent }; 3], |quotients| quotients.map(Value::from));
    Column { values: [det, det_u, det_v, det_t, u, v, t], answer }
}

/// The hit at these `u, v, t` where `t` is in range.
fn answer(ray: &Ray, [u, v, t]: [f32; 3]) -> Conclusion {
    first_within([t], |&t| Place::of(t, ray)).map_or_else(Conclusion::Miss, |t| Conclusion::hit([t, u, v]))
}

/// As `crates/cpu/src/classic/triangle.rs` computes it.
fn by_the_book(ray: &Ray, triangle: &Triangle) -> (System, TriangleColumn) {
    let [a, b, c, direction, origin] =
        [triangle.a, triangle.b, triangle.c, ray.direction, ray.origin].map(|p| p.to_array());
    let e1 = sub(b, a);
    let e2 = sub(c, a);
    let s = sub(origin, a);
    let p = cross3(e2, e1);
    let determinant = dot3(direction, p);
    let m = cross3(direction, s);
    let [det_u, det_v, det_t] = [-dot3(e2, m), dot3(e1, m), -dot3(s, p)];
    let [u, v, t] = [det_u, det_v, det_t].map(|x| x / determinant);
    let why = if determinant == 0.0 {
        Some("det = 0")
    } else if v < 0.0 {
        Some("v < 0")
    } else if v > 1.0 {
        Some("v > 1")
    } else if u < 0.0 {
        Some("u < 0")
    } else if u > 1.0 - v {
        Some("u > 1 - v")
    } else {
        (u.is_nan() || v.is_nan()).then_some(NAN)
    };
    let answer = why.map_or_else(|| answer(ray, [u, v, t]), Conclusion::Miss);
    let quotients = (determinant != 0.0).then_some([u, v, t]);
    let system = system([e1, e2, direction.map(|x| -x), s]);
    (system, column([determinant, det_u, det_v, det_t], quotients, answer))
}

/// As `crates/cpu/src/fast/triangle.rs` and `crates/cpu/src/double/triangle.rs` compute it: with `a - b` and `a - e`, and so
/// with determinants of the other sign.
fn shifted<N: Float>(ray: &Ray, triangle: &Triangle) -> (System, TriangleColumn)
where
    Value: From<N>,
{
    let [a, b, c, d, origin] =
        [triangle.a, triangle.b, triangle.c, ray.direction, ray.origin].map(|p| p.to_array().map(N::widen));
    let zero = N::widen(0.0);
    let p = sub(a, origin);
    let e1 = sub(a, b);
    let e2 = sub(c, a);
    let normal = cross3(e2, e1);
    let r = cross3(p, d);
    let determinant = dot3(normal, d);
    let numerators = [dot3(r, e2), dot3(r, e1), dot3(normal, p)];
    let signed = |x: N| if determinant < zero { -x } else { x };
    let scale = signed(determinant);
    let [u, v, t] = numerators.map(signed);
    let quotients = [u, v, t].map(|x| x / scale);
    let answer = if u >= zero && v >= zero && u + v <= scale && scale > zero {
        answer(ray, quotients.map(N::narrow))
    } else {
        Conclusion::Miss(rejected(&[u, v, u + v, scale], &zero))
    };
    let flip = |x: N| -x;
    let system = system([e1.map(flip), e2, d.map(flip), p.map(flip)]);
    let [det_u, det_v, det_t] = numerators.map(flip);
    let quotients = (determinant != zero).then_some(quotients);
    (system, column([-determinant, det_u, det_v, det_t], quotients, answer))
}

/// Why the numerators of `u`, `v` and `u + v` and their positive denominator, or zero, are rejected.
fn rejected<T: PartialOrd>([u, v, sum, scale]: &[T; 4], zero: &T) -> &'static str {
    if scale == zero {
        "det = 0"
    } else if u < zero {
        "u < 0"
    } else if v < zero {
        "v < 0"
    } else if sum > scale {
        "u + v > 1"
    } else {
        NAN
    }
}

/// In real numbers.
fn exact(ray: &Ray, triangle: &Triangle) -> (System, TriangleColumn) {
    let Triangle { a, b, c } = *triangle;
    if ray.fault().is_some() || ![a, b, c].into_iter().all(Vec3::is_finite) {
        return absent(INVALID);
    }
    let Line { e, d, .. } = Line::new(ray);
    let [a, b, c] = [a, b, c].map(rational::vector);
    let (e1, e2, s) = (rational::sub(&b, &a), rational::sub(&c, &a), rational::sub(&e, &a));
    let down = d.map(|x| -x);
    let det = |x: &Vector, y: &Vector, z: &Vector| rational::dot(x, &rational::cross(y, z));
    let determinant = det(&e1, &e2, &down);
    let numerators = [det(&s, &e2, &down), det(&e1, &s, &down), det(&e1, &e2, &s)];
    let signed = |x: &Number| if determinant < Number::ZERO { -x } else { x.clone() };
    let (scale, [u, v, _]) = (signed(&determinant), numerators.each_ref().map(signed));
    let sum = &u + &v;
    let quotients = (!determinant.is_zero()).then(|| numerators.each_ref().map(|x| x / &determinant));
    let answer = match &quotients {
        Some([weight_u, weight_v, t]) if u >= Number::ZERO && v >= Number::ZERO && sum <= scale => {
            let t = t.clone().canonicalize().into();
            first_within([t], |t| Place::of_exact(t, ray)).map_or_else(Conclusion::Miss, |t| Conclusion::Hit {
                t: Value::Exact(t),
                u: weight_u.clone().into(),
                v: weight_v.clone().into(),
            })
        }
        _ => Conclusion::Miss(rejected(&[u, v, sum, scale], &Number::ZERO)),
    };
    let [det_u, det_v, det_t] = numerators;
    let column = column([determinant, det_u, det_v, det_t], quotients, answer);
    (system([e1, e2, down, s]), column)
}
