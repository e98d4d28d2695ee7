//! Twin of `shaders/exact/leaf/both_roots.wgsl`.

use super::candidate::{Candidate, candidate_at};
use crate::twin::exact::number::Number;
use crate::twin::exact::sphere::Chord;

/// Both roots, each for itself.
#[inline(always)]
pub(crate) fn both_roots<N: Number<Mask = bool> + PartialOrd>(chord: &Chord<N>) -> [Candidate<N>; 2] {
    let roots = [chord.middle - chord.half, chord.middle + chord.half];
    if chord.enters {
        return roots.map(|t| candidate_at(t, chord.off));
    }
    let open = Candidate { certain: false, low: roots[0] - chord.off, high: roots[1] + chord.off };
    [open, open]
}
