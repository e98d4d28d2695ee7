//! A ray and a sphere.

use dashu_base::Sign;
use dashu_ratio::RBig;
use rayproof_scene::{Precision, Ray, Sphere};

use super::float::{Float, dot3, sub};
use super::range::{Place, first_within};
use super::{COLUMNS, Column, Conclusion, Heading, INVALID, Value};
use crate::rational::{self, Line, Number};
use crate::root::Root;

/// The quantities.
pub(super) const ROWS: [Heading; 14] = [
    ("o.x", "e.x - c.x"),
    ("o.y", "e.y - c.y"),
    ("o.z", "e.z - c.z"),
    ("A", "d.d"),
    ("B", "2 d.o"),
    ("C", "o.o - r^2"),
    ("l.x", "o.x - (B / 2A) d.x"),
    ("l.y", "o.y - (B / 2A) d.y"),
    ("l.z", "o.z - (B / 2A) d.z"),
    ("r^2 - l.l", "r^2 - l.l"),
    ("D", "B^2 - 4 A C; fast, double: 4 A (r^2 - l.l)"),
    ("q", "-(B + sgn(B) sqrt D) / 2"),
    ("t1", "q / A; textbook: (-B - sgn(B) sqrt D) / 2A"),
    ("t2", "C / q, or t1 where q = 0; textbook: (-B + sgn(B) sqrt D) / 2A"),
];

type SphereColumn = Column<{ ROWS.len() }>;

/// Every precision's column.
pub(super) fn columns(ray: &Ray, sphere: &Sphere) -> [SphereColumn; 5] {
    COLUMNS.map(|precision| match precision {
        Precision::Textbook | Precision::Classic => by_the_book(ray, sphere, precision),
        Precision::Fast => by_the_foot::<f32>(ray, sphere),
        Precision::Pair | Precision::Double => by_the_foot::<f64>(ray, sphere),
        Precision::Exact => exact(ray, sphere),
    })
}

/// Why there are no roots where no comparison tells.
const NAN: &str = "D is not a number";

/// `q, t1, t2` and the answer where there are no roots.
fn without_roots(why: &'static str) -> ([Value; 3], Conclusion) {
    ([const { Value::Absent }; 3], Conclusion::Miss(why))
}

/// Two parameters, the smaller one first.
fn ordered<T: PartialOrd>(t1: T, t2: T) -> [T; 2] {
    if t1 < t2 { [t1, t2] } else { [t2, t1] }
}

/// The hit at the first of these parameters that is in range.
fn answer(ray: &Ray, parameters: [f32; 2]) -> Conclusion {
    first_within(parameters, |&t| Place::of(t, ray)).map_or_else(Conclusion::Miss, |t| Conclusion::hit([t, 0.0, 0.0]))
}

/// As `crates/cpu/src/textbook/sphere.rs` and `crates/cpu/src/classic/sphere.rs` compute it.
fn by_the_book(ray: &Ray, &Sphere { center, radius }: &Sphere, precision: Precision) -> SphereColumn {
    let direction = ray.direction.to_array();
    let o = sub(ray.origin.to_array(), center.to_array());
    let a = dot3(direction, direction);
    let b = 2.0 * dot3(direction, o);
    let c = dot3(o, o) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    let ([q, t1, t2], answer) = if discriminant >= 0.0 && a > 0.0 {
        let root = discriminant.sqrt();
        if precision == Precision::Textbook {
            let near = (-b - root) / (2.0 * a);
            let far = (-b + root) / (2.0 * a);
            let [t1, t2] = if b >= 0.0 { [near, far] } else { [far, near] };
            ([Value::Absent, t1.into(), t2.into()], answer(ray, [near, far]))
        } else {
            let q = -0.5 * (b + if b >= 0.0 { root } else { -root });
            let t1 = q / a;
            let t2 = if q == 0.0 { t1 } else { c / q };
            ([q, t1, t2].map(Value::F32), answer(ray, ordered(t1, t2)))
        }
    } else if discriminant < 0.0 {
        without_roots("D < 0")
    } else if discriminant.is_nan() {
        without_roots(NAN)
    } else {
        without_roots("A = 0")
    };
    let [x, y, z] = o.map(Value::F32);
    let [a, b, c, discriminant] = [a, b, c, discriminant].map(Value::F32);
    let [lx, ly, lz, rest] = [const { Value::Absent }; 4];
    Column { values: [x, y, z, a, b, c, lx, ly, lz, rest, discriminant, q, t1, t2], answer }
}

/// As `crates/cpu/src/fast/sphere.rs` and `crates/cpu/src/double/sphere.rs` compute it, with half of `B` and a quarter of
/// `D`.
fn by_the_foot<N: Float>(ray: &Ray, &Sphere { center, radius }: &Sphere) -> SphereColumn {
    let [d, origin, center] = [ray.direction, ray.origin, center].map(|p| p.to_array().map(N::widen));
    let (zero, radius) = (N::widen(0.0), N::widen(radius));
    let o = sub(origin, center);
    let a = dot3(d, d);
    let b = dot3(d, o);
    let foot = b / a;
    let l = [o[0] - foot * d[0], o[1] - foot * d[1], o[2] - foot * d[2]];
    let rest = radius * radius - dot3(l, l);
    let c = dot3(o, o) - radius * radius;
    let discriminant = a * rest;
    let ([q, t1, t2], answer) = if discriminant >= zero {
        let root = discriminant.sqrt();
        let q = -(b + if b >= zero { root } else { -root });
        let t1 = q / a;
        let t2 = if q == zero { t1 } else { c / q };
        ([q, t1, t2].map(N::into), answer(ray, ordered(t1.narrow(), t2.narrow())))
    } else {
        without_roots(if discriminant < zero { "D < 0" } else { NAN })
    };
    let [x, y, z] = o.map(N::into);
    let [lx, ly, lz] = l.map(N::into);
    let [a, b, c, rest] = [a, N::widen(2.0) * b, c, rest].map(N::into);
    let discriminant = (N::widen(4.0) * discriminant).into();
    Column { values: [x, y, z, a, b, c, lx, ly, lz, rest, discriminant, q, t1, t2], answer }
}

/// In real numbers.
fn exact(ray: &Ray, sphere: &Sphere) -> SphereColumn {
    if ray.fault().is_some() || !sphere.center.is_finite() || !(0.0..f32::INFINITY).contains(&sphere.radius) {
        return Column::absent(INVALID);
    }
    let two = || Number::from(2);
    let Line { e, d, .. } = Line::new(ray);
    let o = rational::sub(&e, &rational::vector(sphere.center));
    let a = rational::dot(&d, &d);
    let b = two() * rational::dot(&d, &o);
    let r2 = rational::number(sphere.radius).sqr();
    let c = rational::dot(&o, &o) - &r2;
    let foot = &b / (two() * &a);
    let l = [&o[0] - &foot * &d[0], &o[1] - &foot * &d[1], &o[2] - &foot * &d[2]];
    let rest = r2 - rational::dot(&l, &l);
    let discriminant = b.sqr() - Number::from(4) * &a * &c;
    let ([q, t1, t2], answer) = if discriminant >= Number::ZERO {
        // -(B + sgn(B) sqrt D) / 2k = -B / 2k - sgn(B) sqrt(D / 4 k^2), for k = 1 and A; the other root has the other sign.
        let sign = if b >= Number::ZERO { Sign::Negative } else { Sign::Positive };
        let root = |k: &Number, sign: Sign| {
            let half = -&b / (two() * k);
            let radicand = &discriminant / (Number::from(4) * k.sqr());
            Root::new(half.canonicalize(), sign, radicand.canonicalize())
        };
        let (q, t1, t2) = (root(&Number::ONE, sign), root(&a, sign), root(&a, -sign));
        let answer = first_within(ordered(&t1, &t2), |t| Place::of_exact(t, ray)).map_or_else(Conclusion::Miss, |t| {
            let zero = || Value::Exact(RBig::ZERO.into());
            Conclusion::Hit { t: Value::Exact(t.clone()), u: zero(), v: zero() }
        });
        ([q, t1, t2].map(Value::Exact), answer)
    } else {
        without_roots("D < 0")
    };
    let [x, y, z] = o.map(Value::from);
    let [lx, ly, lz] = l.map(Value::from);
    let [a, b, c, rest, discriminant] = [a, b, c, rest, discriminant].map(Value::from);
    Column { values: [x, y, z, a, b, c, lx, ly, lz, rest, discriminant, q, t1, t2], answer }
}
