//! Code compiled once more for wider instruction sets, chosen when it runs.
#![cfg_attr(
    target_arch = "x86_64",
    expect(unsafe_code, reason = "a function compiled for AVX2 is called once the processor is known to have it")
)]

/// Runs `work`, compiled for AVX2 where the processor has it: three-operand instructions, the same operations. Neither
/// version fuses anything, so the bits are the same.
#[inline(always)]
pub(crate) fn run(work: impl FnOnce()) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn avx2(work: impl FnOnce()) {
            work();
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2.
            unsafe { avx2(work) };
            return;
        }
    }
    work();
}
