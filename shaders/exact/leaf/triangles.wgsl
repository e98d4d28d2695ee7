// The triangles of a leaf that are not certainly missed.
fn candidate_of(at: Estimate, crosses: bool) -> Candidate {
    return Candidate(
        at.clear && crosses,
        pick(n(-FARTHEST), sub(at.value, at.off), at.clear),
        pick(n(FARTHEST), add(at.value, at.off), at.clear),
    );
}

fn intersect_triangles(ray: PreparedRay, word: u32, before: Found) -> Found {
    var found = before;
    let first = leaf_first(word);
    let end = first + leaf_count(word);
    for (var i = first; i < end; i += 1u) {
        let triangle = load_triangle(i);
        let s = sides(ray.line, triangle);
        if !triangle_misses(s) {
            let at = plane_t(ray.line, s, triangle.edge);
            found = take(ray, candidate_of(at, triangle_crosses(s)), place_of(TRIANGLE, i), found);
        }
    }
    return found;
}
