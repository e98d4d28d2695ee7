//! What single precision can know of a line and a triangle.
//!
//! Moeller and Trumbore's method on origin-shifted vertices computes, with `C = a - e`, `e1 = b - a`, `e2 = c - a`
//! (edges between stored vertices), `R = C x d` and `N = e1 x e2`,
//!
//! ```text
//! U = R . e2    V = -R . e1    det = N . d    T = N . C    u = U / det    v = V / det    t = T / det
//! ```
//!
//! up to a common sign. In IEEE `f32`, unit roundoff `h = 2^-24`, to first order, roundings a term:
//!
//! | value | of its factors | products and sums | together |
//! |---|---|---|---|
//! | `R` | `C` 1 | product 1, difference 1 | 3 |
//! | `U`, `V` | `R` 3, edge 1 | product 1, two sums 2 | 7 |
//! | `N` | edges 2 | product 1, difference 1 | 4 |
//! | `det` | `N` 4 | product 1, two sums 2 | 7 |
//! | `T` | `N` 4, `C` 1 | product 1, two sums 2 | 8 |
//!
//! each relative to the sum of the absolute values of its terms, `(|x| x+ |y|) . |z|` with `x+` the cross product
//! with plus signs. That is at most `2/sqrt(3) |x| |y| |z|`: with unit vectors, `| |x| x+ |y| |^2 =
//! 1 + (|x|.|y|)^2 - 2 sum (x_i y_i)^2 <= 1 + (1 - 2/3) (|x|.|y|)^2 <= 4/3` by Cauchy. With `8 * 2/sqrt(3) = 9.24`,
//! and a little for the second order and for a reciprocal in place of a division, [`K`]` = 10`:
//!
//! ```text
//! dU = K h |C| |d| |e2|   dV = K h |C| |d| |e1|   ddet = K h |e1| |e2| |d|   dT = K h |e1| |e2| |C|
//! ```
//!
//! A quotient `x = fl(X / det)` has two roundings at most, so its residual against the exact values is bounded by
//!
//! ```text
//! |x det - X| <= dX + |x| (ddet + 2 h |det|)
//! ```
//!
//! That is the promise, for `t`, `u` and `v`. It needs no division, and holds however ill-conditioned the triangle
//! is. Divided by `|det|` it reads: the error of `t d` is at most `K h kappa (|C| + |t d|)` and a little more, with
//! `kappa = |e1| |e2| |d| / |det|` Cramer's condition number, and so for the distance from each edge.
//!
//! Hit or miss may come out otherwise than in exact arithmetic only where the sign of `U`, `V`, `W = det - U - V`,
//! `det` or `T - t_end det` is within these bounds of zero. `dW` is the sum of the three and of the roundings of
//! `U + V` and of the comparison.
//!
//! Products that underflow add at most half the smallest subnormal each, here [`TINY`], scaled up by the factors that
//! follow and by `d`, whether or not the kernel first scales `d` to about one. Where one could overflow nothing is
//! promised.
//!
//! All this is evaluated in `f64`, whose own errors are 2^-29 of the bounds; they are inside the slack of `K`.

use glam::DVec3;
use rayproof_scene::{FlatHit, Ray, Triangle};

use super::promise::{Bounded, HUGE, ROUNDOFF, TINY, ends};

/// Roundings counted above, times `2/sqrt(3)`.
const K: f64 = 10.0;

/// The exact values for one ray and triangle, and how far off single precision may be.
pub(super) struct TrianglePromise {
    det: Bounded,
    u: Bounded,
    v: Bounded,
    w: Bounded,
    t: Bounded,
    /// Whether a product may overflow: nothing is promised.
    beyond: bool,
}

impl TrianglePromise {
    pub(super) fn new(ray: &Ray, triangle: &Triangle) -> Self {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|v| v.as_dvec3());
        let d = ray.direction.as_dvec3();
        let (p, e1, e2) = (a - ray.origin.as_dvec3(), b - a, c - a);
        let [len_p, len_1, len_2, len_d] = [p, e1, e2, d].map(DVec3::length);
        let (r, n) = (p.cross(d), e1.cross(e2));
        let bounded = |value: f64, size: f64, factor: f64| Bounded {
            value,
            error: K * ROUNDOFF * size + TINY * (1.0 + factor) * len_d.max(1.0),
        };
        let det = bounded(n.dot(d), len_1 * len_2 * len_d, len_d);
        let u = bounded(r.dot(e2), len_p * len_d * len_2, len_2);
        let v = bounded(-r.dot(e1), len_p * len_d * len_1, len_1);
        let t = bounded(n.dot(p), len_1 * len_2 * len_p, len_p);
        let sums = 2.0 * ROUNDOFF * (u.value.abs() + v.value.abs() + det.value.abs());
        let w = Bounded { value: det.value - u.value - v.value, error: u.error + v.error + det.error + sums };
        let [far, edge, speed] = [len_p, len_1.max(len_2), len_d].map(|x| x.max(1.0));
        let beyond = (far * edge * speed).max(edge * edge * far.max(speed)) > HUGE;
        Self { det, u, v, w, t, beyond }
    }

    /// The residual of the quotient `x = X / det` over its bound: at most 1 where single precision may give `x`.
    fn residual(&self, x: f64, numerator: Bounded) -> f64 {
        let Bounded { value: det, error } = self.det;
        let bound = numerator.error + x.abs() * (error + 2.0 * ROUNDOFF * det.abs()) + TINY * det.abs();
        (x * det - numerator.value).abs() / bound
    }

    /// The largest error over its bound of the claim that the ray hits the triangle here.
    pub(super) fn claim(&self, hit: &FlatHit) -> f64 {
        if self.beyond {
            return 0.0;
        }
        if hit.t.is_infinite() {
            // A quotient that overflowed: possible where the exact one may, too.
            return self.overflow();
        }
        let parts = [(hit.t, self.t), (hit.u, self.u), (hit.v, self.v)];
        parts.into_iter().map(|(x, numerator)| self.residual(f64::from(x), numerator)).fold(0.0, f64::max)
    }

    /// 0 where `t` may overflow, else infinite.
    fn overflow(&self) -> f64 {
        let (t, det) = (self.t.value.abs() + self.t.error, (self.det.value.abs() - self.det.error).max(0.0));
        if t >= HUGE * det { 0.0 } else { f64::INFINITY }
    }

    /// Whether single precision gives the parameters `t` and `x` in one order or the other.
    pub(super) fn confuses_t(&self, x: f32) -> bool {
        self.beyond || (x.is_finite() && self.residual(f64::from(x), self.t) <= 1.0)
    }

    /// Whether single precision may miss this triangle, which exact arithmetic hits in range.
    pub(super) fn may_miss(&self, ray: &Ray) -> bool {
        let at_edge = [self.u, self.v, self.w, self.det].iter().any(|x| x.value.abs() <= x.error);
        self.beyond || at_edge || self.overflow() == 0.0 || ends(ray).any(|x| self.confuses_t(x))
    }

    /// Whether single precision may hit this triangle in range.
    pub(super) fn may_hit(&self, ray: &Ray) -> bool {
        let with_sign = |s: f64| {
            let reaches = |x: Bounded| s * x.value >= -x.error;
            let end = |x: f32, side: f64| {
                let x = f64::from(x);
                let past = side * s * (self.t.value - x * self.det.value) >= 0.0;
                x.is_infinite() || past || self.residual(x, self.t) <= 1.0
            };
            [self.det, self.u, self.v, self.w].into_iter().all(reaches) && end(ray.t_min, 1.0) && end(ray.t_max, -1.0)
        };
        self.beyond || with_sign(1.0) || with_sign(-1.0)
    }
}
