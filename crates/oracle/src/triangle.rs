//! A line and a triangle, exactly.
//!
//! With `p_i = v_i - e` for the vertices `a, b, c`, the edge function
//!
//! ```text
//! E_ij = d . (p_i x p_j) = d . (p_i x (v_j - v_i))
//! ```
//!
//! tells on which side of the line the edge from `v_i` to `v_j` passes. `E_bc, E_ca, E_ab` are the weights of
//! `a, b, c` at the line's point in the plane, times their sum `det = d . ((b - a) x (c - a))`; and
//! `t = p_a . (p_b x p_c) / det`. A line with `det = 0` lies in the plane, is parallel to it, or there is no plane:
//! never a hit.
//!
//! # The tie rule of counting
//!
//! On an edge or a vertex of a mesh some edge function is zero, and the closed triangles around it are all hit. To
//! cross the surface there exactly once, the line is shifted by `s = eps b1 + eps^2 b2` with `eps` positive and
//! smaller than any number: `b1, b2` are the two coordinate axes after that of `d`'s (first) largest component, in
//! cyclic order (simulation of simplicity, Edelsbrunner and Muecke 1990). With `w = v_j - v_i` the shift turns
//! `E_ij` into
//!
//! ```text
//! d . ((p_i - s) x w) = E_ij - eps b1 . (w x d) - eps^2 b2 . (w x d)
//! ```
//!
//! so the sign of `E_ij` is that of the first of the three terms that is not zero. All are zero only where `w` is
//! parallel to `d`; then `det = 0`. The shifted line meets no edge and no vertex, so on a closed mesh it crosses as
//! often in as out: once where the surface lies on both sides of the line, and 0 or 2 times on a silhouette.
//! `E_ji = -E_ij` holds for the shifted values too, so both triangles of an edge judge it alike. `t` is that of the
//! unshifted line.

use std::cmp::Ordering;

use dashu_ratio::RBig;
use rayproof_scene::Triangle;

use crate::{
    rational::{Line, Number, Vector, cross, dot, sub, vector},
    root::Root,
};

/// The point where a line meets the plane of a triangle.
pub(crate) struct PlanePoint {
    /// The edge functions `E_bc, E_ca, E_ab`, made positive for a point in the triangle.
    weights: [Number; 3],
    /// Their sum, above zero.
    det: Number,
    /// The parameter of the point, times `det`.
    t: Number,
}

impl PlanePoint {
    /// `None` where the line is parallel to the plane or there is no plane.
    pub(crate) fn new(line: &Line, triangle: &Triangle) -> Option<Self> {
        let [a, b, c] = corners(line, triangle);
        let bc = cross(&b, &c);
        let weights = [dot(&line.d, &bc), dot(&line.d, &cross(&c, &a)), dot(&line.d, &cross(&a, &b))];
        let t = dot(&a, &bc);
        let det = &weights[0] + &weights[1] + &weights[2];
        match det.cmp(&Number::ZERO) {
            Ordering::Equal => None,
            Ordering::Greater => Some(Self { weights, det, t }),
            Ordering::Less => Some(Self { weights: weights.map(|w| -w), det: -det, t: -t }),
        }
    }

    /// Whether the closed triangle holds the point.
    pub(crate) fn is_inside(&self) -> bool {
        self.weights.iter().all(|w| *w >= Number::ZERO)
    }

    /// The parameter `t` of the point on the line.
    pub(crate) fn t(&self) -> Root {
        Root::from((&self.t / &self.det).canonicalize())
    }

    /// The weights `[u, v]` of the second and the third vertex.
    pub(crate) fn uv(&self) -> [RBig; 2] {
        [&self.weights[1], &self.weights[2]].map(|w| (w / &self.det).canonicalize())
    }
}

/// The vertices as seen from the origin, `p_i = v_i - e`.
fn corners(line: &Line, triangle: &Triangle) -> [Vector; 3] {
    [triangle.a, triangle.b, triangle.c].map(|v| sub(&vector(v), &line.e))
}

/// Whether the shifted line crosses the triangle: see the tie rule above.
pub(crate) fn crosses(line: &Line, triangle: &Triangle) -> bool {
    let [a, b, c] = corners(line, triangle);
    let ab = edge_sign(line, &a, &b);
    ab != Ordering::Equal && ab == edge_sign(line, &b, &c) && ab == edge_sign(line, &c, &a)
}

/// The sign of the edge function of the shifted line; `Equal` only for an edge parallel to the line.
fn edge_sign(line: &Line, p: &Vector, q: &Vector) -> Ordering {
    let w_x_d = cross(&sub(q, p), &line.d);
    // d . (p x w) = p . (w x d).
    let [first, second] = line.ties.map(|axis| Number::ZERO.cmp(&w_x_d[axis]));
    dot(p, &w_x_d).cmp(&Number::ZERO).then(first).then(second)
}
