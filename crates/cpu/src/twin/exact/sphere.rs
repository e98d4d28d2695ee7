//! Twin of `shaders/exact/sphere.wgsl`, where the bounds are derived.

use super::line::Line;
use super::number::Number;
use super::vector::{Vector, dot_n};

/// What is known of a line and a sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chord<N: Number> {
    /// The line certainly misses, or certainly enters.
    pub(crate) misses: N::Mask,
    pub(crate) enters: N::Mask,
    /// The roots are `middle - half` and `middle + half`, each within `off`; where it is not certain that the line enters,
    /// whatever roots there are lie between `middle - half - off` and `middle + half + off`.
    pub(crate) middle: N,
    pub(crate) half: N,
    pub(crate) off: N,
}

#[inline(always)]
pub(crate) fn chord<N: Number>(ray: &Line<N>, center: Vector<N>, radius: N) -> Chord<N> {
    let zero = N::constant(0.0);
    let o = ray.origin - center;
    let middle = zero - dot_n(ray.direction, o) * ray.inverse_a;
    let d = ray.direction;
    let l = Vector { x: o.x + middle * d.x, y: o.y + middle * d.y, z: o.z + middle * d.z };
    let rr = radius * radius;
    let square = rr - dot_n(l, l);
    let far = o.largest();
    let foot = far * ray.foot_error;
    let off_square = (radius + radius + foot) * foot + rr * ray.root_error + ray.tiny_sphere;
    let off_middle = far * ray.middle_error + ray.tiny_sphere;
    let misses = (square + off_square).less(zero);
    let enters = (off_square + off_square).less(square);
    // Where it is not certain that the line enters, the longest chord there may be.
    let longest = square.max(zero) + off_square;
    let half = (N::pick(longest, square, enters) * ray.inverse_a).sqrt();
    let off_half = N::pick(zero, off_square * ray.inverse_a / N::pick(N::constant(1.0), half, enters), enters);
    let off = off_middle + off_half * N::constant(1.0625) + (half * ray.root_error + middle.abs() * ray.root_error);
    Chord { misses, enters, middle, half, off }
}
