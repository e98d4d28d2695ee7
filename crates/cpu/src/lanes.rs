//! Four triangles abreast. Each lane does what the kernel does for one triangle, in the same order, so its bits are the
//! same; where the kernel returns early, a lane is masked.

use glam::{Vec3, Vec3A, Vec4};
use rayproof_tree::PackedTriangle;

use crate::twin::exact::vector::Vector;

/// Three corners, and the largest component of the edges at `a`, rounded up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners<N> {
    pub(crate) a: Vector<N>,
    pub(crate) b: Vector<N>,
    pub(crate) c: Vector<N>,
    pub(crate) edge: N,
}

/// A leaf's triangles; lanes without one hold a point, which is never hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangles4 {
    pub(crate) corners: Corners<Vec4>,
    pub(crate) ids: [u32; 4],
}

impl Triangles4 {
    /// One to four triangles.
    pub(crate) fn new(triangles: &[PackedTriangle]) -> Self {
        let lane = |k: usize| triangles.get(k).map_or([Vec3::ZERO; 3], |t| [t.a, t.b, t.c]);
        let lanes = [lane(0), lane(1), lane(2), lane(3)];
        let corner = |i: usize| {
            let lanes = |axis: usize| Vec4::from_array(lanes.map(|corners: [Vec3; 3]| corners[i][axis]));
            Vector { x: lanes(0), y: lanes(1), z: lanes(2) }
        };
        let edge = Vec4::from_array([0, 1, 2, 3].map(|k| triangles.get(k).map_or(0.0, |t| t.edge)));
        let id = |k: usize| triangles.get(k).map_or(u32::MAX, |t| t.id);
        let corners = Corners { a: corner(0), b: corner(1), c: corner(2), edge };
        Self { corners, ids: [id(0), id(1), id(2), id(3)] }
    }

    /// The corners of lane `k`.
    #[inline(always)]
    pub(crate) fn corners(&self, k: usize) -> [[f32; 3]; 3] {
        let Corners { a, b, c, .. } = &self.corners;
        [a, b, c].map(|v| [v.x[k], v.y[k], v.z[k]])
    }
}

/// Four triangles' answers: bit `k` of `hits` tells whether lane `k` is hit in range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidates {
    pub(crate) hits: u32,
    pub(crate) t: Vec4,
    pub(crate) u: Vec4,
    pub(crate) v: Vec4,
}

pub(crate) const NO_HITS: Candidates = Candidates { hits: 0, t: Vec4::ZERO, u: Vec4::ZERO, v: Vec4::ZERO };

/// A point in every lane.
#[inline(always)]
pub(crate) fn splat(p: Vec3A) -> Vector<Vec4> {
    Vector { x: Vec4::splat(p.x), y: Vec4::splat(p.y), z: Vec4::splat(p.z) }
}
