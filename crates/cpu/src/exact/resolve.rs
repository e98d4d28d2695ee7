//! The third stage: what exact arithmetic says of one ray and one primitive, or two.
//!
//! Every coordinate is a whole number times a power of two. With `k` the smallest such power among the positions and `h`
//! that among the direction, `t` is `2^(k - h)` times a quotient, or a root of a quadratic, of whole numbers; `u` and `v` are
//! quotients. All is decided by signs of polynomials in them: 128 bits hold those of a triangle whose coordinates differ by
//! less than 40 bits, and big integers the rest.
//!
//! **The tie rule of counting.** The ray's line is taken to be shifted by `eps b1 + eps^2 b2`, `eps` positive and smaller than
//! any number, `b1` and `b2` the axes after that of the direction's first largest component, in cyclic order (simulation of
//! simplicity, Edelsbrunner and Muecke 1990). The edge function of an edge `w` from a corner `p` is `(p x w).d = p.(w x d)`;
//! shifted it is `p.(w x d) - eps b1.(w x d) - eps^2 b2.(w x d)`, whose sign is that of its first term that is not zero. Both
//! triangles of an edge use the same numbers, so a closed mesh is crossed once wherever it is crossed.

use std::cmp::Ordering::{self, Equal, Greater, Less};

use num_bigint::BigInt;
use rayproof_scene::Kind;

use super::ring::{Narrow, Ring};
use crate::twin::exact::vector::Vector;

/// A ray in `f64`, exact: every number is an `f32` times one power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactRay {
    pub(crate) origin: [f64; 3],
    pub(crate) direction: [f64; 3],
    /// May be infinite.
    pub(crate) t_min: f64,
    pub(crate) t_max: f64,
}

/// A primitive in the same units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Triangle([[f64; 3]; 3]),
    Sphere { center: [f64; 3], radius: f64 },
}

impl Shape {
    pub(crate) const fn kind(&self) -> Kind {
        match self {
            Self::Triangle(_) => Kind::Triangle,
            Self::Sphere { .. } => Kind::Sphere,
        }
    }
}

/// Whether the closed primitive is hit in range.
pub(crate) fn is_hit(ray: &ExactRay, shape: &Shape) -> bool {
    exactly(|| first::<Narrow>(ray, shape).map(|f| f.is_some()), || first::<BigInt>(ray, shape).map(|f| f.is_some()))
}

/// How many times the surface is crossed in range, by the tie rule; a tangent of a sphere counts twice.
pub(crate) fn crossings(ray: &ExactRay, shape: &Shape) -> u32 {
    exactly(|| count::<Narrow>(ray, shape), || count::<BigInt>(ray, shape))
}

/// Which of two primitives, both hit in range, is hit first; `Equal` for one `t`.
pub(crate) fn compare(ray: &ExactRay, a: &Shape, b: &Shape) -> Ordering {
    if a == b {
        return Equal;
    }
    exactly(|| order::<Narrow>(ray, a, b), || order::<BigInt>(ray, a, b))
}

/// `t 2^exponent`, `u` and `v` of a primitive that is hit in range, each rounded to the nearest; `guess` is where to look first.
pub(crate) fn rounded(ray: &ExactRay, shape: &Shape, exponent: i32, guess: [f32; 3]) -> [f32; 3] {
    exactly(|| round_all::<Narrow>(ray, shape, exponent, guess), || round_all::<BigInt>(ray, shape, exponent, guess))
}

/// The answer in 128 bits, or else in as many as it takes.
fn exactly<T>(narrow: impl FnOnce() -> Option<T>, wide: impl FnOnce() -> Option<T>) -> T {
    narrow().or_else(wide).expect("big integers never give up")
}

/// A number as an odd mantissa and an exponent; `None` for zero.
fn parts(x: f64) -> Option<(i64, i32)> {
    if x == 0.0 {
        return None;
    }
    let (bits, sign) = (x.to_bits(), if x < 0.0 { -1 } else { 1 });
    #[expect(clippy::cast_possible_wrap, reason = "11 bits, and 53")]
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    debug_assert!((1..0x7ff).contains(&exponent), "f32 and their multiples are normal f64");
    let mantissa = fraction | 1 << 52;
    let zeros = mantissa.trailing_zeros();
    #[expect(clippy::cast_possible_wrap, reason = "at most 52")]
    let exponent = exponent - 1075 + zeros as i32;
    Some((sign * (mantissa >> zeros), exponent))
}

/// The smallest exponent of any of these numbers.
fn unit(numbers: impl Iterator<Item = f64>) -> i32 {
    numbers.filter_map(parts).map(|(_, e)| e).min().unwrap_or(0)
}

/// `x / 2^unit` as a whole number.
fn whole<R: Ring>(x: f64, unit: i32) -> R {
    parts(x).map_or_else(|| R::new(0, 0), |(mantissa, e)| R::new(mantissa, (e - unit).unsigned_abs()))
}

type Point<R> = Vector<R>;

fn point<R: Ring>(p: [f64; 3], unit: i32) -> Point<R> {
    p.map(|x| whole(x, unit)).into()
}

fn sub<R: Ring>(a: &Point<R>, b: &Point<R>) -> Point<R> {
    Vector { x: a.x.sub(&b.x), y: a.y.sub(&b.y), z: a.z.sub(&b.z) }
}

fn dot<R: Ring>(a: &Point<R>, b: &Point<R>) -> R {
    a.x.mul(&b.x).add(&a.y.mul(&b.y)).add(&a.z.mul(&b.z))
}

fn cross<R: Ring>(a: &Point<R>, b: &Point<R>) -> Point<R> {
    let minor = |p: &R, q: &R, r: &R, s: &R| p.mul(q).sub(&r.mul(s));
    Vector { x: minor(&a.y, &b.z, &a.z, &b.y), y: minor(&a.z, &b.x, &a.x, &b.z), z: minor(&a.x, &b.y, &a.y, &b.x) }
}

/// A line and the units that make its numbers, and those of the shapes it meets, whole.
struct WholeLine<R> {
    e: Point<R>,
    d: Point<R>,
    position: i32,
    /// `t` is a quotient of whole numbers times two to this.
    scale: i32,
}

impl<R: Ring> WholeLine<R> {
    fn new(ray: &ExactRay, shapes: &[&Shape]) -> Self {
        let positions = shapes.iter().flat_map(|shape| match **shape {
            Shape::Triangle([a, b, c]) => a.into_iter().chain(b).chain(c).collect::<Vec<f64>>(),
            Shape::Sphere { center: [x, y, z], radius } => vec![x, y, z, radius],
        });
        let (position, direction) = (unit(ray.origin.into_iter().chain(positions)), unit(ray.direction.into_iter()));
        let (e, d) = (point(ray.origin, position), point(ray.direction, direction));
        Self { e, d, position, scale: position - direction }
    }
}

/// `(numerator + sign sqrt(radicand)) / denominator 2^scale`, with a positive denominator.
struct Root<R> {
    numerator: R,
    denominator: R,
    /// -1, 0 or 1; 0 where there is no root.
    sign: i8,
    radicand: R,
    scale: i32,
}

/// The sign of `a + s sqrt(b)`, `b` not negative.
fn sign_of<R: Ring>(a: &R, s: i8, b: &R) -> Option<Ordering> {
    let root = if s == 0 || b.sign()? == Equal { Equal } else { s.cmp(&0) };
    Some(match (a.sign()?, root) {
        (x, Equal) => x,
        (Equal, y) => y,
        (x, y) if x == y => x,
        (Greater, _) => a.mul(a).compare(b)?,
        (_, _) => b.compare(&a.mul(a))?,
    })
}

impl<R: Ring> Root<R> {
    /// A quotient; the denominator is not zero.
    fn quotient(numerator: R, denominator: R, scale: i32) -> Option<Self> {
        let negative = denominator.sign()? == Less;
        let [numerator, denominator] = [numerator, denominator].map(|x| if negative { x.negated() } else { x });
        Some(Self { numerator, denominator, sign: 0, radicand: R::new(0, 0), scale })
    }

    /// How it compares with a number, which may be infinite.
    fn compare_number(&self, x: f64) -> Option<Ordering> {
        if x.is_infinite() {
            return Some(if x > 0.0 { Less } else { Greater });
        }
        let Some((mantissa, exponent)) = parts(x) else {
            return sign_of(&self.numerator, self.sign, &self.radicand);
        };
        let (up, down) = ((exponent - self.scale).max(0).unsigned_abs(), (self.scale - exponent).max(0).unsigned_abs());
        if self.sign == 0 {
            return R::compare_products(&self.numerator, &R::new(1, down), &R::new(mantissa, up), &self.denominator);
        }
        let a = self.numerator.shifted(down).sub(&R::new(mantissa, up).mul(&self.denominator));
        sign_of(&a, self.sign, &self.radicand.shifted(2 * down))
    }

    fn is_within(&self, ray: &ExactRay) -> Option<bool> {
        Some(self.compare_number(ray.t_min)? != Less && self.compare_number(ray.t_max)? != Greater)
    }

    /// How it compares with another of the same scale.
    fn compare(&self, other: &Self) -> Option<Ordering> {
        if self.sign == 0 && other.sign == 0 {
            return R::compare_products(&self.numerator, &other.denominator, &other.numerator, &self.denominator);
        }
        // The sign of x + s sqrt(y) + z sqrt(w), all over the product of the denominators.
        let x = self.numerator.mul(&other.denominator).sub(&other.numerator.mul(&self.denominator));
        let squared = |a: &R| a.mul(a);
        let (y, w) = (self.radicand.mul(&squared(&other.denominator)), other.radicand.mul(&squared(&self.denominator)));
        let (s, z) = (self.sign, -other.sign);
        let roots = match (s, z) {
            (s, 0) => s.cmp(&0),
            (0, z) => z.cmp(&0),
            (s, z) if s == z => s.cmp(&0),
            (s, _) => {
                if s > 0 {
                    y.compare(&w)?
                } else {
                    w.compare(&y)?
                }
            }
        };
        Some(match (x.sign()?, roots) {
            (a, Equal) => a,
            (Equal, b) => b,
            (a, b) if a == b => a,
            (a, b) => {
                // Opposite signs: the larger square wins.
                let rest = squared(&x).sub(&y).sub(&w);
                match sign_of(&rest, -(s * z), &y.mul(&w).shifted(2))? {
                    Greater => a,
                    Equal => Equal,
                    Less => b,
                }
            }
        })
    }

    /// The nearest `f32`, ties to even; infinite beyond the largest by the same rule; never a negative zero.
    fn nearest(&self, guess: f32) -> Option<f32> {
        let sign = self.compare_number(0.0)?;
        if sign == Equal {
            return Some(0.0);
        }
        let s = if sign == Less { -1.0 } else { 1.0 };
        // The lowest k such that the magnitude lies below the middle of the numbers k and k + 1, or on it where k is even.
        let reaches = |k: u32| -> Option<bool> {
            if k == INFINITE {
                return Some(true);
            }
            let order = self.compare_number(s * upper_middle(k))?;
            let order = if s < 0.0 { order.reverse() } else { order };
            Some(order == Less || (order == Equal && k.is_multiple_of(2)))
        };
        let guess = guess.abs().to_bits().min(INFINITE);
        let (mut low, mut high) = (0, INFINITE);
        if reaches(guess)? {
            high = guess;
            if guess == 0 || !reaches(guess - 1)? {
                low = guess;
            }
        } else {
            low = guess + 1;
        }
        while low < high {
            let middle = low + (high - low) / 2;
            if reaches(middle)? {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "one or minus one")]
        let signed = f32::from_bits(low) * s as f32;
        Some(if low == 0 { 0.0 } else { signed })
    }
}

const INFINITE: u32 = f32::INFINITY.to_bits();

/// The middle of the numbers with bits `k` and `k + 1`, exact; above the largest, where the next one would be.
fn upper_middle(k: u32) -> f64 {
    let number = |k: u32| f64::from(f32::from_bits(k));
    if k + 1 == INFINITE { number(k) + 2.0_f64.powi(103) } else { (number(k) + number(k + 1)) / 2.0 }
}

/// A triangle's edge functions for the second and the third corner, the determinant, and the numerator of `t`.
struct Plane<R> {
    u: R,
    v: R,
    determinant: R,
    t: R,
}

impl<R: Ring> Plane<R> {
    fn new(line: &WholeLine<R>, corners: &[[f64; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(|v| point(v, line.position));
        let (p, e1, e2) = (sub(&a, &line.e), sub(&a, &b), sub(&c, &a));
        let (n, r) = (cross(&e2, &e1), cross(&p, &line.d));
        Self { u: dot(&r, &e2), v: dot(&r, &e1), determinant: dot(&n, &line.d), t: dot(&n, &p) }
    }

    /// Where the closed triangle is hit.
    fn root(self, line: &WholeLine<R>) -> Option<Option<Root<R>>> {
        let w = self.determinant.sub(&self.u).sub(&self.v);
        let side = self.determinant.sign()?;
        if side == Equal {
            return Some(None);
        }
        for weight in [&self.u, &self.v, &w] {
            if weight.sign()? == side.reverse() {
                return Some(None);
            }
        }
        Root::quotient(self.t, self.determinant, line.scale).map(Some)
    }
}

/// Both roots of a sphere, the near one first; one for a tangent.
fn sphere_roots<R: Ring>(line: &WholeLine<R>, center: [f64; 3], radius: f64) -> Option<Vec<Root<R>>> {
    let o = sub(&line.e, &point(center, line.position));
    let r: R = whole(radius, line.position);
    let (a, b) = (dot(&line.d, &line.d), dot(&line.d, &o));
    let c = dot(&o, &o).sub(&r.mul(&r));
    let radicand = b.mul(&b).sub(&a.mul(&c));
    let root = |sign| Root {
        numerator: b.negated(),
        denominator: a.clone(),
        sign,
        radicand: radicand.clone(),
        scale: line.scale,
    };
    Some(match radicand.sign()? {
        Less => vec![],
        Equal => vec![root(0)],
        Greater => vec![root(-1), root(1)],
    })
}

/// Where a shape is first hit in range.
fn first_on<R: Ring>(line: &WholeLine<R>, ray: &ExactRay, shape: &Shape) -> Option<Option<Root<R>>> {
    let roots = match shape {
        Shape::Triangle(corners) => Plane::new(line, corners).root(line)?.into_iter().collect(),
        Shape::Sphere { center, radius } => sphere_roots(line, *center, *radius)?,
    };
    for root in roots {
        if root.is_within(ray)? {
            return Some(Some(root));
        }
    }
    Some(None)
}

fn first<R: Ring>(ray: &ExactRay, shape: &Shape) -> Option<Option<Root<R>>> {
    first_on(&WholeLine::new(ray, &[shape]), ray, shape)
}

fn order<R: Ring>(ray: &ExactRay, a: &Shape, b: &Shape) -> Option<Ordering> {
    let line: WholeLine<R> = WholeLine::new(ray, &[a, b]);
    match (first_on(&line, ray, a)?, first_on(&line, ray, b)?) {
        (Some(a), Some(b)) => a.compare(&b),
        // Both are hit, by the caller's word.
        (a, b) => Some(b.is_some().cmp(&a.is_some())),
    }
}

fn count<R: Ring>(ray: &ExactRay, shape: &Shape) -> Option<u32> {
    let line: WholeLine<R> = WholeLine::new(ray, &[shape]);
    match shape {
        Shape::Triangle(corners) => {
            if !is_crossed(&line, ray, corners)? {
                return Some(0);
            }
            let plane = Plane::new(&line, corners);
            if plane.determinant.sign()? == Equal {
                return Some(0);
            }
            Root::quotient(plane.t, plane.determinant, line.scale)?.is_within(ray).map(u32::from)
        }
        Shape::Sphere { center, radius } => {
            let roots = sphere_roots(&line, *center, *radius)?;
            let each = if roots.len() == 1 { 2 } else { 1 };
            roots.iter().map(|root| Some(each * u32::from(root.is_within(ray)?))).sum()
        }
    }
}

/// Whether the shifted line crosses a triangle.
fn is_crossed<R: Ring>(line: &WholeLine<R>, ray: &ExactRay, corners: &[[f64; 3]; 3]) -> Option<bool> {
    let [x, y, z] = ray.direction.map(f64::abs);
    let axis = if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    };
    let [a, b, c] = corners.map(|v| sub(&point(v, line.position), &line.e));
    let side = |p: &Point<R>, q: &Point<R>| -> Option<Ordering> {
        let w_x_d = cross(&sub(q, p), &line.d);
        let shift = |i: usize| {
            let Vector { x, y, z } = &w_x_d;
            [x, y, z][(axis + i) % 3].sign().map(Ordering::reverse)
        };
        Some(dot(p, &w_x_d).sign()?.then(shift(1)?).then(shift(2)?))
    };
    let ab = side(&a, &b)?;
    Some(ab != Equal && ab == side(&b, &c)? && ab == side(&c, &a)?)
}

fn round_all<R: Ring>(ray: &ExactRay, shape: &Shape, exponent: i32, guess: [f32; 3]) -> Option<[f32; 3]> {
    let line: WholeLine<R> = WholeLine::new(ray, &[shape]);
    let mut t = first_on(&line, ray, shape)??;
    t.scale += exponent;
    let t = t.nearest(guess[0])?;
    match shape {
        Shape::Triangle(corners) => {
            let Plane { u, v, determinant, .. } = Plane::new(&line, corners);
            let u = Root::quotient(u, determinant.clone(), 0)?.nearest(guess[1])?;
            let v = Root::quotient(v, determinant, 0)?.nearest(guess[2])?;
            Some([t, u, v])
        }
        Shape::Sphere { .. } => Some([t, 0.0, 0.0]),
    }
}

#[cfg(test)]
mod tests;
