//! Twin of `shaders/exact/leaf/first_root.wgsl`.

use super::candidate::{Candidate, candidate_at};
use crate::twin::exact::number::Number;
use crate::twin::exact::sphere::Chord;

/// The root that is hit first in range: the near one, or the far one where the near one lies before the range.
#[inline(always)]
pub(crate) fn first_root<N: Number<Mask = bool> + PartialOrd>(c: &Chord<N>, t_min: N) -> Candidate<N> {
    let (near, far) = (c.middle - c.half, c.middle + c.half);
    if c.enters && near - c.off >= t_min {
        return candidate_at(near, c.off);
    }
    if c.enters && near + c.off < t_min {
        return candidate_at(far, c.off);
    }
    Candidate { certain: false, low: near - c.off, high: far + c.off }
}
