//! What single precision can know of a line and a sphere.
//!
//! Hearn and Baker's method computes, with `o = e - c`, `a = d.d`, `b = o.d`, `l = o - (b / a) d`,
//! `D = a (r^2 - l.l)`, `c' = o.o - r^2` and `q = -(b + sgn(b) sqrt(D))`, the roots `q / a` and `c' / q`. `d` is first
//! scaled, exactly, to a length of about one; so all is said here in lengths: the centre of the chord `m = -b / |d|`,
//! the half chord `h = sqrt(r^2 - l^2)`, the root `X = t |d|`. In IEEE `f32`, unit roundoff `u = 2^-24`, to first
//! order:
//!
//! * `o`: 1 rounding, so `u |o|`. `b`: `o` 1, product 1, two sums 2, so `4 u |o| |d|`. `a`: 3.
//! * `(b / a) d`: `b` 4, `a` 3, quotient 1, product 1, so `9 u |o|`. `l`: that, `o` 1, difference 1: `11 u |o|`.
//! * `l.l`: `2 u r` more in length: 3 roundings, halved. `r^2`, the difference: `u r`. Together the silhouette is
//!   known to `B1 = K u (|o| + r)` with [`K`]` = 12`: `l` may pass for any length within `B1` of its own.
//! * So `|h^2 - h*^2| <= B2 = B1 (2 r + B1)` and `|h - h*| <= dh`, the larger of `h* - sqrt(h*^2 - B2)` and
//!   `sqrt(h*^2 + B2) - h*`: about `B2 / 2 h*` for a fat chord and `sqrt(B2)` for a tangent.
//! * `q` in length, `Q = |m| + h`: `dq = 4 u |o| + dh + 3 u h + u Q`: the root of `D` takes half of `a` 3, product 1, and
//!   itself 1.
//! * `q / a`, the root of larger size: `dq`, `a` 3, quotient 1, with `Q <= |o| + r`, so `dh + 9 u |o| + 8 u r`, at
//!   most `dh + B1`.
//! * `c'`: `o` 2, product 1, two sums 2, `r^2` 1, difference 1, so `u (6 |o|^2 + 2 r^2)`. `c' / q`, the other root `X`:
//!   `(dc' + |X| dq) / (Q - dq) + u |X|`. Where `dq` reaches `Q`, a ray that starts at its own point of tangency,
//!   nothing is promised of that root. Elsewhere `|o|^2 / Q <= |m| + r / cos` with `cos = h / r`, so it is
//!   `O(u (|o| + r) / cos)`: no more than `o`'s own roundings would move the root of a perfect method, but for an
//!   origin near a large sphere, where it is the price of `c'`.
//!
//! Underflow adds [`TINY`] to squares and lengths; where squares may overflow nothing is promised. All this is
//! evaluated in `f64`, whose own errors are 2^-28 of the bounds.

use rayproof_scene::{FlatHit, Ray, Sphere};

use super::promise::{Bounded, HUGE, ROUNDOFF, TINY, ends};

/// Roundings of the silhouette counted above.
const K: f64 = 12.0;

/// The exact values for one ray and sphere, and how far off single precision may be.
pub(super) struct SpherePromise {
    /// How far outside the sphere the line passes; negative where it enters.
    outside: f64,
    /// How far the silhouette may be off, `B1`.
    silhouette: f64,
    /// The roots `q / a` and `c' / q`, in length; the middle of the line's part within the silhouette where it misses.
    roots: [Bounded; 2],
    /// The length of the direction.
    d: f64,
    /// Whether a square may overflow: nothing is promised.
    beyond: bool,
}

impl SpherePromise {
    pub(super) fn new(ray: &Ray, sphere: &Sphere) -> Self {
        const U: f64 = ROUNDOFF;
        let (offset, direction) = (ray.origin.as_dvec3() - sphere.center.as_dvec3(), ray.direction.as_dvec3());
        let (o, r, d) = (offset.length(), f64::from(sphere.radius), direction.length());
        let (m, l) = (-offset.dot(direction) / d, offset.cross(direction).length() / d);
        let silhouette = K * U * (o + r) + TINY;
        let h2 = ((r - l) * (r + l)).max(0.0);
        let h = h2.sqrt();
        let b2 = silhouette * (2.0 * r + silhouette) + TINY;
        let dh = (h - (h2 - b2).max(0.0).sqrt()).max((h2 + b2).sqrt() - h);
        let q = m.abs() + h;
        let dq = 4.0 * U * o + dh + 3.0 * U * (h + dh) + U * q + TINY;
        let dc = U * (6.0 * o * o + 2.0 * r * r) + TINY;
        let large = if m > 0.0 { q } else { -q };
        // The other root is c' / large; a miss has none, and may pass for a tangent at m.
        let small = if l > r {
            m
        } else if q > 0.0 {
            (o - r) * (o + r) / large
        } else {
            0.0
        };
        let small_error = if dq < q { (dc + small.abs() * dq) / (q - dq) + U * small.abs() } else { f64::INFINITY };
        Self {
            outside: l - r,
            silhouette,
            roots: [Bounded { value: large, error: dh + silhouette }, Bounded { value: small, error: small_error }],
            d,
            beyond: o.max(r) * o.max(r) > HUGE,
        }
    }

    /// The error of the parameter `t` as one of the roots, over its bound.
    fn off(&self, root: Bounded, t: f32) -> f64 {
        let overflow = root.value.abs() + root.error >= HUGE * self.d;
        match (t.is_infinite(), overflow) {
            (true, true) => 0.0,
            (true, false) => f64::INFINITY,
            (false, _) => (f64::from(t) * self.d - root.value).abs() / (root.error + 2.0 * TINY * self.d),
        }
    }

    /// The largest error over its bound of the claim that the ray hits the sphere here.
    pub(super) fn claim(&self, hit: &FlatHit) -> f64 {
        if self.beyond {
            return 0.0;
        }
        let [large, small] = self.roots.map(|root| self.off(root, hit.t));
        large.min(small).max(self.outside / self.silhouette)
    }

    /// Whether single precision gives the exact root `t` and the parameter `x` in one order or the other.
    pub(super) fn confuses_t(&self, t: f64, x: f32) -> bool {
        let distance = |root: &Bounded| (root.value - t * self.d).abs();
        let root = if distance(&self.roots[0]) < distance(&self.roots[1]) { self.roots[0] } else { self.roots[1] };
        self.beyond || (x.is_finite() && self.off(root, x) <= 1.0)
    }

    /// Whether single precision may miss this sphere, which exact arithmetic hits in range at `t`.
    pub(super) fn may_miss(&self, ray: &Ray, t: f64) -> bool {
        let at_silhouette = self.outside.abs() <= self.silhouette;
        self.beyond || at_silhouette || t.abs() >= HUGE || ends(ray).any(|x| self.confuses_t(t, x))
    }

    /// Whether single precision may hit this sphere in range.
    pub(super) fn may_hit(&self, ray: &Ray) -> bool {
        let reaches = |root: &Bounded| {
            let [low, high] = [ray.t_min, ray.t_max].map(|t| f64::from(t) * self.d);
            root.value + root.error >= low && root.value - root.error <= high
        };
        self.beyond || (self.outside <= self.silhouette && self.roots.iter().any(reaches))
    }
}
