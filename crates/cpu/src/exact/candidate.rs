//! Twin of `shaders/exact/leaf/candidate.wgsl`: where one primitive is hit, with what certainty.

use super::sphere::Chord;
use crate::number::Number;

/// Between which `t` a primitive is hit first, if it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<N> {
    /// Whether it is hit, on its line.
    pub(crate) certain: bool,
    pub(crate) low: N,
    pub(crate) high: N,
}

impl<N: Number<Mask = bool> + PartialOrd> Candidate<N> {
    /// A certain one: `t` within `off`.
    #[inline(always)]
    pub(crate) fn at(t: N, off: N) -> Self {
        Self { certain: true, low: t - off, high: t + off }
    }

    /// The root of a sphere that is hit first in range: the near one, or the far one where the near one lies before the range.
    #[inline(always)]
    pub(crate) fn first_root(chord: &Chord<N>, t_min: N) -> Self {
        let (near, far) = (chord.middle - chord.half, chord.middle + chord.half);
        if chord.enters && near - chord.off >= t_min {
            return Self::at(near, chord.off);
        }
        if chord.enters && near + chord.off < t_min {
            return Self::at(far, chord.off);
        }
        Self { certain: false, low: near - chord.off, high: far + chord.off }
    }

    /// Both roots, each for itself.
    #[inline(always)]
    pub(crate) fn both_roots(chord: &Chord<N>) -> [Self; 2] {
        let roots = [chord.middle - chord.half, chord.middle + chord.half];
        if chord.enters {
            return roots.map(|t| Self::at(t, chord.off));
        }
        let open = Self { certain: false, low: roots[0] - chord.off, high: roots[1] + chord.off };
        [open, open]
    }

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
