// The certain hit that is closest so far, and how near one might be that is not certain.
struct Found {
    // The exact t lies between.
    low: N,
    high: N,
    // The primitive, by its place in the leaves; MISS for none.
    slot: u32,
    // No primitive left open is hit before this.
    doubt: N,
}

fn found_start(ray: PreparedRay) -> Found {
    return Found(n(ray.t_max), n(ray.t_max), MISS, n(NOT_HIT));
}

// Beyond this t nothing more is of interest.
fn found_reach(found: Found) -> f32 {
    return above(found.high);
}

fn found_finished(found: Found) -> bool {
    return ANY_HIT && found.slot != MISS;
}

// Whether the answer is certain.
fn found_decided(found: Found) -> bool {
    return found_finished(found) || less(found.high, found.doubt);
}

fn take(ray: PreparedRay, candidate: Candidate, slot: u32, found: Found) -> Found {
    if is_outside(candidate, n(ray.t_min), found.high) {
        return found;
    }
    let first = found.slot == MISS || less(candidate.high, found.low);
    if first && is_inside(candidate, n(ray.t_min), n(ray.t_max)) {
        return Found(candidate.low, candidate.high, slot, found.doubt);
    }
    return Found(found.low, found.high, found.slot, smaller(found.doubt, candidate.low));
}
