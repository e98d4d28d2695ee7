//! Four triangles abreast. Each lane does what the kernel does for one triangle, in the same order, so its bits are the
//! same; where the kernel returns early, a lane is masked.

use glam::{Vec3, Vec3A, Vec4};
use rayproof_scene::bvh::PackedTriangle;

/// Three coordinates of four points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vec3x4 {
    x: Vec4,
    y: Vec4,
    z: Vec4,
}

impl Vec3x4 {
    fn new(points: [Vec3; 4]) -> Self {
        let lanes = |axis: usize| Vec4::from_array(points.map(|p| p[axis]));
        Self { x: lanes(0), y: lanes(1), z: lanes(2) }
    }

    #[inline(always)]
    pub(crate) fn splat(p: Vec3A) -> Self {
        Self { x: Vec4::splat(p.x), y: Vec4::splat(p.y), z: Vec4::splat(p.z) }
    }
}

impl std::ops::Sub for Vec3x4 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// Twin of `dot3` in `shaders/math.wgsl`.
#[inline(always)]
pub(crate) fn dot3(a: Vec3x4, b: Vec3x4) -> Vec4 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Twin of `cross3` in `shaders/math.wgsl`.
#[inline(always)]
pub(crate) fn cross3(a: Vec3x4, b: Vec3x4) -> Vec3x4 {
    Vec3x4 { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x }
}

/// A leaf's triangles; lanes without one hold a point, which is never hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triangles4 {
    pub(crate) a: Vec3x4,
    pub(crate) b: Vec3x4,
    pub(crate) c: Vec3x4,
    pub(crate) ids: [u32; 4],
}

impl Triangles4 {
    /// One to four triangles.
    pub(crate) fn new(triangles: &[PackedTriangle]) -> Self {
        let lane = |k: usize| triangles.get(k).map_or([Vec3::ZERO; 3], |t| [t.a, t.b, t.c]);
        let lanes = [lane(0), lane(1), lane(2), lane(3)];
        let corner = |i: usize| Vec3x4::new(lanes.map(|corners| corners[i]));
        let id = |k: usize| triangles.get(k).map_or(u32::MAX, |t| t.id);
        Self { a: corner(0), b: corner(1), c: corner(2), ids: [id(0), id(1), id(2), id(3)] }
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
