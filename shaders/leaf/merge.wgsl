// The closest of two: the smaller t, and among equal t the lower number.
fn closer(found: Candidate, id: u32, hit: Hit) -> Hit {
    if found.hit && (found.t < hit.t || (found.t == hit.t && id < hit.primitive)) {
        return Hit(found.t, found.u, found.v, id);
    }
    return hit;
}

fn leaf_first(word: u32) -> u32 {
    return word & 0x0fffffffu;
}

fn leaf_count(word: u32) -> u32 {
    return ((word >> 28u) & 3u) + 1u;
}
