//! The numbers that formulas are written in: one text for four lanes, for `f32`, for wider formats, and, in tests, for an
//! arithmetic that errs wherever WGSL lets it.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use glam::{BVec4A, Vec4};

/// A number, or several abreast.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// One truth a lane.
    type Mask: Mask;

    /// A constant; exact.
    fn constant(x: f32) -> Self;
    fn abs(self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn less(self, other: Self) -> Self::Mask;
    fn equal(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

/// One truth a lane.
pub(crate) trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Bit `k` is lane `k`.
    fn bits(self) -> u32;
}

impl Mask for bool {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}
impl Mask for BVec4A {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.bitmask()
    }
}

/// A format of the processor's own.
macro_rules! native {
    ($float:ty, $constant:expr) => {
        impl Number for $float {
            type Mask = bool;

            #[inline(always)]
            fn constant(x: f32) -> Self {
                $constant(x)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.min(other)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.max(other)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn less(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn equal(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }
    };
}

native!(f32, |x| x);
native!(f64, f64::from);

impl Number for Vec4 {
    type Mask = BVec4A;

    #[inline(always)]
    fn constant(x: f32) -> Self {
        Self::splat(x)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::min(self, other)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::from_array(self.to_array().map(f32::sqrt))
    }
    #[inline(always)]
    fn less(self, other: Self) -> BVec4A {
        self.cmplt(other)
    }
    #[inline(always)]
    fn equal(self, other: Self) -> BVec4A {
        self.cmpeq(other)
    }
    #[inline(always)]
    fn select(mask: BVec4A, yes: Self, no: Self) -> Self {
        Self::select(mask, yes, no)
    }
}

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

/// Twin of `dot3` in `shaders/math.wgsl`.
#[inline(always)]
pub(crate) fn dot3<N: Copy + Add<Output = N> + Mul<Output = N>>(a: Vector<N>, b: Vector<N>) -> N {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Twin of `cross3` in `shaders/math.wgsl`.
#[inline(always)]
pub(crate) fn cross3<N: Copy + Sub<Output = N> + Mul<Output = N>>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    Vector { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x }
}
