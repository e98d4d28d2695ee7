//! Eight numbers abreast, by what the processor has. No instruction set fuses or approximates anything: the bits are the same.
#![cfg_attr(
    target_arch = "x86_64",
    expect(unsafe_code, reason = "instructions are used once the processor is known to have them")
)]

/// Eight numbers in memory.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Eight(pub(crate) [f32; 8]);

/// An instruction set, as a token that shows that the processor has it.
pub(crate) trait Isa: Copy + Send + Sync {
    /// Eight numbers in registers.
    type V: Copy;

    /// Runs work compiled for it.
    fn run<R>(self, work: impl FnOnce() -> R) -> R;
    fn load(self, x: &Eight) -> Self::V;
    fn store(self, x: Self::V) -> Eight;
    fn splat(self, x: f32) -> Self::V;
    fn add(self, a: Self::V, b: Self::V) -> Self::V;
    fn sub(self, a: Self::V, b: Self::V) -> Self::V;
    fn mul(self, a: Self::V, b: Self::V) -> Self::V;
    fn min(self, a: Self::V, b: Self::V) -> Self::V;
    fn max(self, a: Self::V, b: Self::V) -> Self::V;
    /// Bit `k` tells whether `a[k] <= b[k]`.
    fn at_most(self, a: Self::V, b: Self::V) -> u32;
    /// Brings what lies there nearer, if it helps.
    fn prefetch<T>(self, at: &T);
}

/// What every processor has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plain;

#[inline(always)]
fn each(a: Eight, b: Eight, f: impl Fn(f32, f32) -> f32) -> Eight {
    Eight(std::array::from_fn(|k| f(a.0[k], b.0[k])))
}

impl Isa for Plain {
    type V = Eight;

    #[inline(always)]
    fn run<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }
    #[inline(always)]
    fn load(self, x: &Eight) -> Eight {
        *x
    }
    #[inline(always)]
    fn store(self, x: Eight) -> Eight {
        x
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Eight {
        Eight([x; 8])
    }
    #[inline(always)]
    fn add(self, a: Eight, b: Eight) -> Eight {
        each(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, a: Eight, b: Eight) -> Eight {
        each(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, a: Eight, b: Eight) -> Eight {
        each(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn min(self, a: Eight, b: Eight) -> Eight {
        each(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, a: Eight, b: Eight) -> Eight {
        each(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn at_most(self, a: Eight, b: Eight) -> u32 {
        (0..8).fold(0, |bits, k| bits | u32::from(a.0[k] <= b.0[k]) << k)
    }
    #[inline(always)]
    fn prefetch<T>(self, _: &T) {}
}

/// x86-64 with AVX2.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

#[cfg(target_arch = "x86_64")]
impl Avx2 {
    /// Where the processor has it.
    pub(crate) fn new() -> Option<Self> {
        std::arch::is_x86_feature_detected!("avx2").then_some(Self(()))
    }
}

#[cfg(target_arch = "x86_64")]
impl Isa for Avx2 {
    type V = std::arch::x86_64::__m256;

    #[inline(always)]
    fn run<R>(self, work: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx2")]
        fn avx2<R>(work: impl FnOnce() -> R) -> R {
            work()
        }
        // SAFETY: the token shows that the processor has AVX2.
        unsafe { avx2(work) }
    }
    #[inline(always)]
    fn load(self, x: &Eight) -> Self::V {
        // SAFETY: the token, and Eight is aligned to 32 bytes.
        unsafe { std::arch::x86_64::_mm256_load_ps(x.0.as_ptr()) }
    }
    #[inline(always)]
    fn store(self, x: Self::V) -> Eight {
        let mut out = Eight([0.0; 8]);
        // SAFETY: the token, and Eight is aligned to 32 bytes.
        unsafe { std::arch::x86_64::_mm256_store_ps(out.0.as_mut_ptr(), x) };
        out
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_set1_ps(x) }
    }
    #[inline(always)]
    fn add(self, a: Self::V, b: Self::V) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_add_ps(a, b) }
    }
    #[inline(always)]
    fn sub(self, a: Self::V, b: Self::V) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_sub_ps(a, b) }
    }
    #[inline(always)]
    fn mul(self, a: Self::V, b: Self::V) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_mul_ps(a, b) }
    }
    #[inline(always)]
    fn min(self, a: Self::V, b: Self::V) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_min_ps(a, b) }
    }
    #[inline(always)]
    fn max(self, a: Self::V, b: Self::V) -> Self::V {
        // SAFETY: the token.
        unsafe { std::arch::x86_64::_mm256_max_ps(a, b) }
    }
    #[inline(always)]
    fn at_most(self, a: Self::V, b: Self::V) -> u32 {
        use std::arch::x86_64::{_CMP_LE_OQ, _mm256_cmp_ps, _mm256_movemask_ps};
        // SAFETY: the token.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) }.cast_unsigned()
    }
    #[inline(always)]
    fn prefetch<T>(self, at: &T) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        for line in (0..size_of::<T>()).step_by(64) {
            // SAFETY: a hint; the address lies within what is borrowed.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(at).cast::<i8>().add(line)) };
        }
    }
}
