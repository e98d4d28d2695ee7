//! Batches of rays, and even shares of them.

/// Rays a batch: enough to fill a GPU, and 32 MiB.
pub const BATCH: usize = 1 << 20;

/// `i * total / of` without overflow, rounded down, for `i` from 0 to `of`.
pub(crate) fn share(i: u64, of: u64, total: u64) -> u64 {
    let exact = u128::from(i) * u128::from(total) / u128::from(of);
    u64::try_from(exact).expect("no more than the total, since i is no more than of")
}
