//! Twin of `shaders/exact/number/native.wgsl`: numbers that the processor has itself, `f32` four abreast among them.

use glam::{BVec4A, Vec4};

use super::{Mask, Number};

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
            fn pick(no: Self, yes: Self, mask: bool) -> Self {
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
    fn pick(no: Self, yes: Self, mask: BVec4A) -> Self {
        Self::select(mask, yes, no)
    }
}
