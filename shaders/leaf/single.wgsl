// What the precisions in f32 make of a leaf.

// A ray as their formulas take it.
struct PreparedRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
    t_min: f32,
    t_max: f32,
    // Box units: s = t 2^box_exponent.
    box_exponent: i32,
    // What is returned: t 2^out_exponent.
    out_exponent: i32,
}

// One primitive's answer: whether it is hit in range, and where.
struct Candidate {
    hit: bool,
    t: f32,
    u: f32,
    v: f32,
}

const NO_HIT = Candidate(false, 0.0, 0.0, 0.0);

// The closest hit so far.
alias Found = Hit;

fn found_start(ray: PreparedRay) -> Found {
    return Hit(ray.t_max, 0.0, 0.0, MISS);
}

// Beyond this t nothing more is of interest.
fn found_reach(found: Found) -> f32 {
    return found.t;
}

fn found_finished(found: Found) -> bool {
    return ANY_HIT && found.primitive != MISS;
}

// The closer of two: the smaller t, and among equal t the lower number.
fn closer(found: Candidate, id: u32, hit: Hit) -> Hit {
    if found.hit && (found.t < hit.t || (found.t == hit.t && id < hit.primitive)) {
        return Hit(found.t, found.u, found.v, id);
    }
    return hit;
}

// The hit of a ray, as it is returned.
fn trace(given: Ray) -> Hit {
    let unit = unit_direction(given.direction);
    let ray = prepared_ray(given, unit);
    let hit = traverse(unit, ray);
    let t = scale_by_power(without_sign(hit.t), ray.out_exponent);
    // A t that became 0: by its bits, since a subnormal one is no 0.
    return Hit(select(t, 0.0, is_zero(t)), without_sign(hit.u), without_sign(hit.v), hit.primitive);
}
