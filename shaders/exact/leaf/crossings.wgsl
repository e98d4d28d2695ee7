// How many certain crossings there are so far. An edge or a vertex is never certain: the tie rule is left to the CPU.
struct Found {
    count: u32,
    // Whether a crossing was not certain.
    open: bool,
    t_max: f32,
}

fn found_start(ray: PreparedRay) -> Found {
    return Found(0u, false, ray.t_max);
}

fn found_reach(found: Found) -> f32 {
    return found.t_max;
}

fn found_finished(found: Found) -> bool {
    return found.open;
}

fn take(ray: PreparedRay, candidate: Candidate, slot: u32, found: Found) -> Found {
    if is_outside(candidate, n(ray.t_min), n(ray.t_max)) {
        return found;
    }
    let inside = is_inside(candidate, n(ray.t_min), n(ray.t_max));
    return Found(found.count + u32(inside), found.open || !inside, found.t_max);
}
