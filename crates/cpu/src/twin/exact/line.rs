//! Twin of `shaders/exact/line.wgsl`, where the bounds are derived.

use glam::Vec4;
use rayproof_scene::Kind;

use super::number::Number;
use super::vector::{Vector, dot_n};

/// Whether the certificates of a kind take the parts of a line that are for chords: a division and a root.
pub(crate) const fn takes_chords(kind: Kind) -> bool {
    match kind {
        Kind::Triangle => false,
        Kind::Sphere => true,
    }
}

/// A ray's line as certificates take it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<N> {
    pub(crate) origin: Vector<N>,
    pub(crate) direction: Vector<N>,
    /// `20 u (|d_x| + |d_y| + |d_z|)`.
    pub(crate) side_error: N,
    /// `54 u`.
    pub(crate) plane_error: N,
    /// `8 u`.
    pub(crate) round_error: N,
    /// More than all that underflows in a triangle's formulas.
    pub(crate) tiny_triangle: N,
    /// What no bound of a triangle's `t` is below.
    pub(crate) tiny_t: N,
    /// `1 / d.d`; this and what follows is for chords only.
    pub(crate) inverse_a: N,
    /// `28 u`, and `28 u / |d|`.
    pub(crate) foot_error: N,
    pub(crate) middle_error: N,
    /// `12 u`.
    pub(crate) root_error: N,
    /// More than all that underflows in a sphere's formulas.
    pub(crate) tiny_sphere: N,
}

impl<N: Number> Line<N> {
    /// In an arithmetic whose rounding loses at most `u`; `tiny` is what underflow may cost a triangle, its `t`, and a sphere. Without
    /// `chords` what is for them alone is left at zero.
    #[inline(always)]
    pub(crate) fn new(u: f32, origin: Vector<N>, direction: Vector<N>, tiny: [N; 3], chords: bool) -> Self {
        let times = |k: f32| N::constant(k * u);
        let inverse_a = if chords { N::constant(1.0) / dot_n(direction, direction) } else { N::constant(0.0) };
        Self {
            origin,
            direction,
            side_error: direction.manhattan() * times(20.0),
            plane_error: times(54.0),
            round_error: times(8.0),
            tiny_triangle: tiny[0],
            tiny_t: tiny[1],
            inverse_a,
            foot_error: times(28.0),
            middle_error: if chords { inverse_a.sqrt() * times(28.0) } else { N::constant(0.0) },
            root_error: times(12.0),
            tiny_sphere: tiny[2],
        }
    }
}

impl Line<f32> {
    /// These numbers in four lanes, without those for chords.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> Line<Vec4> {
        Line {
            origin: self.origin.map(Vec4::splat),
            direction: self.direction.map(Vec4::splat),
            side_error: Vec4::splat(self.side_error),
            plane_error: Vec4::splat(self.plane_error),
            round_error: Vec4::splat(self.round_error),
            tiny_triangle: Vec4::splat(self.tiny_triangle),
            tiny_t: Vec4::splat(self.tiny_t),
            inverse_a: Vec4::ZERO,
            foot_error: Vec4::ZERO,
            middle_error: Vec4::ZERO,
            root_error: Vec4::ZERO,
            tiny_sphere: Vec4::ZERO,
        }
    }
}
