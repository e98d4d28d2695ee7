//! Twin of `shaders/exact/vector.wgsl`.

use std::ops::{Add, Mul, Sub};

use super::number::Number;

/// Three coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vector<N> {
    pub(crate) x: N,
    pub(crate) y: N,
    pub(crate) z: N,
}

impl<N: Copy> Vector<N> {
    #[inline(always)]
    pub(crate) fn map<M>(self, f: impl Fn(N) -> M) -> Vector<M> {
        Vector { x: f(self.x), y: f(self.y), z: f(self.z) }
    }
}

impl<N> From<[N; 3]> for Vector<N> {
    #[inline(always)]
    fn from([x, y, z]: [N; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<N: Number> Vector<N> {
    /// The largest magnitude.
    #[inline(always)]
    pub(crate) fn largest(self) -> N {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }

    /// The sum of the magnitudes.
    #[inline(always)]
    pub(crate) fn manhattan(self) -> N {
        self.x.abs() + self.y.abs() + self.z.abs()
    }
}

impl<N: Sub<Output = N>> Sub for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

#[inline(always)]
pub(crate) fn dot_n<N: Copy + Add<Output = N> + Mul<Output = N>>(a: Vector<N>, b: Vector<N>) -> N {
    a.x * b.x + a.y * b.y + a.z * b.z
}

#[inline(always)]
pub(crate) fn cross_n<N: Copy + Sub<Output = N> + Mul<Output = N>>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    Vector { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x }
}
