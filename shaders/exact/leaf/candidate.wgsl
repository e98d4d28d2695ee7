// Where one primitive is hit first, with what certainty.
struct Candidate {
    // Whether it is hit, on its line.
    certain: bool,
    low: N,
    high: N,
}

fn candidate_at(t: N, off: N) -> Candidate {
    return Candidate(true, sub(t, off), add(t, off));
}

// Certainly not in range.
fn is_outside(c: Candidate, t_min: N, t_max: N) -> bool {
    return less(t_max, c.low) || less(c.high, t_min);
}

// Certainly hit in range.
fn is_inside(c: Candidate, t_min: N, t_max: N) -> bool {
    return c.certain && !less(c.low, t_min) && !less(t_max, c.high);
}
