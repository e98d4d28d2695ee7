// The root that is hit first in range: the near one, or the far one where the near one lies before the range.
fn first_root(c: Chord, t_min: N) -> Candidate {
    let near = candidate_at(sub(c.middle, c.half), c.off);
    let far = candidate_at(add(c.middle, c.half), c.off);
    if c.enters && !less(near.low, t_min) {
        return near;
    }
    if c.enters && less(near.high, t_min) {
        return far;
    }
    return Candidate(false, near.low, far.high);
}

fn take_chord(ray: PreparedRay, chord: Chord, slot: u32, found: Found) -> Found {
    return take(ray, first_root(chord, n(ray.t_min)), slot, found);
}
