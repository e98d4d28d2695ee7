//! Where a line meets a primitive: a number known by how it compares with others.

use std::cmp::Ordering;

use rayproof_scene::{Ray, Sphere, Triangle};

use super::expansion::{Expansion, Vector, cross, dot, minus, vector};

/// `None` where numbers are too far apart for expansions.
pub(super) type Known<T> = Option<T>;

/// The line of a ray.
pub(super) struct Line {
    e: Vector,
    d: Vector,
    /// The axes in which it is shifted to count: those after that of `d`'s first largest component, in cyclic order.
    shifts: [usize; 2],
}

impl Line {
    pub(super) fn new(ray: &Ray) -> Self {
        let size = ray.direction.abs().to_array();
        let mut largest = 0;
        for axis in 1..3 {
            if size[axis] > size[largest] {
                largest = axis;
            }
        }
        Self { e: vector(ray.origin), d: vector(ray.direction), shifts: [(largest + 1) % 3, (largest + 2) % 3] }
    }
}

/// A quotient of two exact numbers, its denominator positive.
#[derive(Clone, Debug)]
pub(super) struct Quotient {
    numerator: Expansion,
    denominator: Expansion,
}

/// A root of `a t^2 + 2 b t + c` with `a > 0`: the larger or the smaller one.
#[derive(Clone, Debug)]
pub(super) struct Root {
    a: Expansion,
    b: Expansion,
    c: Expansion,
    larger: bool,
}

/// A parameter on a line.
#[derive(Clone, Debug)]
pub(super) enum Parameter {
    Plane(Quotient),
    Sphere(Root),
}

impl Quotient {
    pub(super) fn order(&self, x: f64) -> Known<Ordering> {
        (&self.numerator - &(&Expansion::from(x) * &self.denominator)).sign()
    }

    fn estimate(&self) -> f64 {
        self.numerator.estimate() / self.denominator.estimate()
    }
}

impl Root {
    /// How the root compares with a point where the quadratic, and its slope, have these signs.
    fn order_of_point(&self, value: Ordering, slope: Ordering) -> Ordering {
        match value {
            // Between the roots.
            Ordering::Less if self.larger => Ordering::Greater,
            Ordering::Less => Ordering::Less,
            // Beyond both: behind the larger one the slope is positive.
            Ordering::Greater => slope.reverse(),
            // At the one on that side; at both where it has no slope.
            Ordering::Equal => match (slope, self.larger) {
                (Ordering::Less, true) => Ordering::Greater,
                (Ordering::Greater, false) => Ordering::Less,
                _ => Ordering::Equal,
            },
        }
    }

    /// How the root compares with `x = p / q`, `q > 0`: by the sign of the quadratic there, times `q^2`, and of its slope.
    fn order_of_ratio(&self, p: &Expansion, q: &Expansion) -> Known<Ordering> {
        let slope = &(&self.a * p) + &(&self.b * q);
        let value = &(&(&self.a * &p.square()) + &(&(&self.b * p) * &(q + q))) + &(&self.c * &q.square());
        Some(self.order_of_point(value.sign()?, slope.sign()?))
    }

    /// `b^2 - a c`.
    fn discriminant(&self) -> Expansion {
        &self.b.square() - &(&self.a * &self.c)
    }

    fn estimate(&self) -> f64 {
        let [a, b, c] = [&self.a, &self.b, &self.c].map(Expansion::estimate);
        let root = self.discriminant().estimate().max(0.0).sqrt();
        // The one without cancellation, then the other by their product.
        let q = if b > 0.0 { -b - root } else { -b + root };
        if (b > 0.0) != self.larger && q != 0.0 {
            q / a
        } else if q == 0.0 {
            0.0
        } else {
            c / q
        }
    }

    /// Two roots with the same `a`, of the quadratics `Q1` and `Q2`. At this one, `Q1 = 0` and so `Q2 = Q2 - Q1`, which is
    /// linear: `q t - p` with `q = 2 (b2 - b1)` and `p = c1 - c2`. Its sign there, and that of the slope `2 (a t + b2)`, are
    /// how this root compares with the ratios `p / q` and `-b2 / a`.
    fn order_of_root(&self, other: &Self) -> Known<Ordering> {
        let (half, p) = (&other.b - &self.b, &self.c - &other.c);
        let q = &half + &half;
        let value = match q.sign()? {
            Ordering::Greater => self.order_of_ratio(&p, &q)?,
            Ordering::Equal => p.sign()?.reverse(),
            Ordering::Less => self.order_of_ratio(&-&p, &-&q)?.reverse(),
        };
        let slope = self.order_of_ratio(&-&other.b, &self.a)?;
        Some(other.order_of_point(value, slope).reverse())
    }
}

impl Parameter {
    /// How it compares with a number.
    pub(super) fn order(&self, x: f64) -> Known<Ordering> {
        match self {
            Self::Plane(quotient) => quotient.order(x),
            Self::Sphere(root) => root.order_of_ratio(&Expansion::from(x), &Expansion::from(1.0_f64)),
        }
    }

    /// How it compares with another on the same line.
    pub(super) fn order_of(&self, other: &Self) -> Known<Ordering> {
        match (self, other) {
            (Self::Plane(a), Self::Plane(b)) => {
                (&(&a.numerator * &b.denominator) - &(&b.numerator * &a.denominator)).sign()
            }
            (Self::Sphere(a), Self::Plane(b)) => a.order_of_ratio(&b.numerator, &b.denominator),
            (Self::Plane(_), Self::Sphere(_)) => other.order_of(self).map(Ordering::reverse),
            (Self::Sphere(a), Self::Sphere(b)) => a.order_of_root(b),
        }
    }

    /// A close `f64`.
    pub(super) fn estimate(&self) -> f64 {
        match self {
            Self::Plane(quotient) => quotient.estimate(),
            Self::Sphere(root) => root.estimate(),
        }
    }

    /// The nearest `f32`.
    pub(super) fn nearest(&self) -> Known<f32> {
        nearest(self.estimate(), |x| self.order(x))
    }
}

/// A line in the plane of a triangle, by Cramer's rule: with `s = e - a`, `e1 = b - a`, `e2 = c - a` and `n = e1 x e2`,
/// `det = n.d`, `det u = d.(s x e2)`, `det v = d.(e1 x s)` and `det t = -n.s`.
pub(super) struct PlaneHit {
    pub(super) t: Parameter,
    pub(super) u: Quotient,
    pub(super) v: Quotient,
    /// Whether the closed triangle holds the point.
    pub(super) inside: bool,
    /// Whether the shifted line crosses it.
    pub(super) crosses: bool,
}

impl PlaneHit {
    /// `Some(None)` where line and plane are parallel, or there is no plane.
    pub(super) fn new(line: &Line, triangle: &Triangle) -> Known<Option<Self>> {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(vector);
        let (s, e1, e2) = (minus(&line.e, &a), minus(&b, &a), minus(&c, &a));
        let n = cross(&e1, &e2);
        let det = dot(&n, &line.d);
        let side = det.sign()?;
        if side == Ordering::Equal {
            return Some(None);
        }
        let oriented = |x: Expansion| if side == Ordering::Less { -&x } else { x };
        let (u_raw, v_raw) = (dot(&line.d, &cross(&s, &e2)), dot(&line.d, &cross(&e1, &s)));
        let w_raw = &(&det - &u_raw) - &v_raw;
        let weights = [u_raw.sign()?, v_raw.sign()?, w_raw.sign()?];
        let inside = weights.iter().all(|&sign| sign == side || sign == Ordering::Equal);
        // u is linear in e: moving e along an axis moves d.(s x e2) by (e2 x d) in that axis, and d.(e1 x s) by (d x e1).
        let (du, dv) = (cross(&e2, &line.d), cross(&line.d, &e1));
        let shifted = |sign: Ordering, by: &dyn Fn(usize) -> Expansion| -> Known<Ordering> {
            let [first, second] = line.shifts.map(by);
            Some(sign.then(first.sign()?).then(second.sign()?))
        };
        let signs = [
            shifted(weights[0], &|axis| du[axis].clone())?,
            shifted(weights[1], &|axis| dv[axis].clone())?,
            shifted(weights[2], &|axis| -&(&du[axis] + &dv[axis]))?,
        ];
        let crosses = signs.iter().all(|&sign| sign == side);
        let quotient = |x: Expansion| Quotient { numerator: oriented(x), denominator: oriented(det.clone()) };
        let t = Parameter::Plane(quotient(-&dot(&n, &s)));
        Some(Some(Self { t, u: quotient(u_raw), v: quotient(v_raw), inside, crosses }))
    }
}

/// The roots of `|e + t d - c|^2 = r^2`, multiplied out; one twice where they are one, none where there are none.
pub(super) fn roots(line: &Line, sphere: &Sphere) -> Known<Vec<Parameter>> {
    let o = minus(&line.e, &vector(sphere.center));
    let (a, b) = (dot(&line.d, &line.d), dot(&o, &line.d));
    let c = &dot(&o, &o) - &Expansion::from(sphere.radius).square();
    let root = |larger| Root { a: a.clone(), b: b.clone(), c: c.clone(), larger };
    if root(false).discriminant().sign()? == Ordering::Less {
        return Some(Vec::new());
    }
    Some(vec![Parameter::Sphere(root(false)), Parameter::Sphere(root(true))])
}

/// The weight's nearest `f32`.
pub(super) fn weight(x: &Quotient) -> Known<f32> {
    nearest(x.estimate(), |y| x.order(y))
}

/// The `f32` nearest to a number, ties to even, by how the number compares with the middles between neighbours; `estimate` is
/// only where the search starts. Zero has no sign; infinity stands for `2^128`.
fn nearest(estimate: f64, order: impl Fn(f64) -> Known<Ordering>) -> Known<f32> {
    let value = |x: f32| if x.is_infinite() { 2.0_f64.powi(128).copysign(f64::from(x)) } else { f64::from(x) };
    #[expect(clippy::cast_possible_truncation, reason = "a guess")]
    let mut x = if estimate.is_nan() { 0.0 } else { estimate as f32 };
    loop {
        let even = x.to_bits().is_multiple_of(2);
        let middle = |to: f32| 0.5 * (value(x) + value(to));
        if x < f32::INFINITY {
            let order = order(middle(x.next_up()))?;
            if order == Ordering::Greater || (order == Ordering::Equal && !even) {
                x = x.next_up();
                continue;
            }
        }
        if x > f32::NEG_INFINITY {
            let order = order(middle(x.next_down()))?;
            if order == Ordering::Less || (order == Ordering::Equal && !even) {
                x = x.next_down();
                continue;
            }
        }
        return Some(x + 0.0);
    }
}
