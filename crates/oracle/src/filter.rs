//! What a line surely misses, in `f64`: the rest is decided exactly.
//!
//! Every input is an `f32`, exact in `f64`. Write `h = 2^-53` for the unit roundoff; a value that went through `n`
//! rounded operations is off by a factor of at most `(1 + h)^n`, that is by `g_n = n h / (1 - n h)` relative to the
//! sum of the absolute values of its terms. Nothing over- or underflows: inputs are multiples of `2^-149` below
//! `2^128`, so products of four of them or of their differences lie between `2^-596` and `2^516`, or are zero.
//!
//! * **Outcodes.** Let `k` be the axis of `d`'s largest component and `i` another. The vector `n = d_k e_i - d_i e_k`
//!   is stored exactly and is perpendicular to `d`, so `f(v) = n . (v - e)` is zero all along the line. Computed as
//!   `d_k p_i - d_i p_k` with `p = v - e` each term has three roundings: `|error| <= g_3 (|d_k p_i| + |d_i p_k|)`.
//!   Where `f` is beyond that at all three vertices of a triangle, and of one sign, the line misses the triangle, for
//!   it lies in the half space of its vertices. Two `n` give four flags a vertex: computed once, shared by all the
//!   triangles around it.
//! * **Edges.** `E_ij = d . (p_i x (v_j - v_i))` has seven roundings in each of its six terms (two differences, a
//!   product, a difference, a product, two sums): `|error| <= g_7 P`, `P` the sum of their absolute values. The
//!   closed triangle is met only where no two of its three edge functions have opposite signs, so two certain
//!   opposite signs are a miss. (A line parallel to the plane is a miss as well, whatever its signs.)
//! * **Spheres.** The line misses where `|o x d|^2 > r^2 |d|^2`. A component of `o x d` has three roundings a term:
//!   `|error| <= g_3 (|o_i d_j| + |o_j d_i|)`; lowered by that much and clamped at zero it is a lower bound. Both
//!   sides are sums of positive terms with at most five more roundings each.
//!
//! The code allows [`SLACK`]` = 16 h` for each of these, more than twice what is needed; that also covers the rounding
//! of the bounds themselves.

use glam::{DVec3, Vec3};
use rayproof_scene::{Ray, Sphere, Triangle};

use crate::rational::other_axes;

/// `16 h`: see above.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// The line of a ray, ready to reject.
pub(crate) struct Filter {
    e: DVec3,
    d: DVec3,
    /// The axis of the largest component of `d`.
    k: usize,
    /// The other two.
    others: [usize; 2],
}

impl Filter {
    pub(crate) fn new(ray: &Ray) -> Self {
        let others = other_axes(ray.direction);
        Self { e: ray.origin.as_dvec3(), d: ray.direction.as_dvec3(), k: 3 - others[0] - others[1], others }
    }

    /// Four flags: surely on the positive or the negative side of the two planes through the line.
    ///
    /// Triangles whose three outcodes share a flag are missed.
    pub(crate) fn outcode(&self, v: Vec3) -> u8 {
        let p = v.as_dvec3() - self.e;
        let side = |i: usize| {
            let (x, y) = (self.d[self.k] * p[i], self.d[i] * p[self.k]);
            let bound = SLACK * (x.abs() + y.abs());
            u8::from(x - y > bound) | u8::from(x - y < -bound) << 1
        };
        side(self.others[0]) | side(self.others[1]) << 2
    }

    /// Whether the line surely misses the triangle, by its edges.
    pub(crate) fn misses_triangle(&self, triangle: &Triangle) -> bool {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(Vec3::as_dvec3);
        let signs = self.edge(a, b) | self.edge(b, c) | self.edge(c, a);
        signs == 3
    }

    /// 1 for an edge function that is surely positive, 2 for surely negative, else 0.
    fn edge(&self, v: DVec3, w: DVec3) -> u8 {
        let (p, w) = (v - self.e, w - v);
        let cross = DVec3::new(p.y * w.z - p.z * w.y, p.z * w.x - p.x * w.z, p.x * w.y - p.y * w.x);
        let (q, x, d) = (p.abs(), w.abs(), self.d.abs());
        let absolute = DVec3::new(q.y * x.z + q.z * x.y, q.z * x.x + q.x * x.z, q.x * x.y + q.y * x.x);
        let (value, bound) = (self.d.dot(cross), SLACK * d.dot(absolute));
        u8::from(value > bound) | u8::from(value < -bound) << 1
    }

    /// Whether the line surely misses the sphere.
    pub(crate) fn misses_sphere(&self, sphere: &Sphere) -> bool {
        let (o, d) = (self.e - sphere.center.as_dvec3(), self.d);
        let component = |i: usize, j: usize| {
            let (x, y) = (o[i] * d[j], o[j] * d[i]);
            ((x - y).abs() - SLACK * (x.abs() + y.abs())).max(0.0)
        };
        let (x, y, z) = (component(1, 2), component(2, 0), component(0, 1));
        let r = f64::from(sphere.radius);
        x * x + y * y + z * z > r * r * d.length_squared() * (1.0 + 2.0 * SLACK)
    }
}
