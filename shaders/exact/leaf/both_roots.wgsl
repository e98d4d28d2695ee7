// Both roots, each for itself.
fn take_chord(ray: PreparedRay, chord: Chord, slot: u32, before: Found) -> Found {
    let near = candidate_at(sub(chord.middle, chord.half), chord.off);
    let far = candidate_at(add(chord.middle, chord.half), chord.off);
    if !chord.enters {
        return take(ray, Candidate(false, near.low, far.high), slot, before);
    }
    return take(ray, far, slot, take(ray, near, slot, before));
}
