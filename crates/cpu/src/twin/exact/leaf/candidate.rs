//! Twin of `shaders/exact/leaf/candidate.wgsl`.

use crate::twin::exact::number::Number;

/// Where one primitive is hit first, with what certainty. (The kernels' other `Candidate`, of the precisions in `f32`, has its
/// twin in `leaf/single.rs`.)
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<N> {
    /// Whether it is hit, on its line.
    pub(crate) certain: bool,
    pub(crate) low: N,
    pub(crate) high: N,
}

/// A certain one: `t` within `off`.
#[inline(always)]
pub(crate) fn candidate_at<N: Number>(t: N, off: N) -> Candidate<N> {
    Candidate { certain: true, low: t - off, high: t + off }
}

impl<N: Number<Mask = bool> + PartialOrd> Candidate<N> {
    /// Whether it is certainly not in range.
    #[inline(always)]
    pub(crate) fn is_outside(&self, t_min: N, t_max: N) -> bool {
        self.low > t_max || self.high < t_min
    }

    /// Whether it is certainly hit in range.
    #[inline(always)]
    pub(crate) fn is_inside(&self, t_min: N, t_max: N) -> bool {
        self.certain && self.low >= t_min && self.high <= t_max
    }
}
