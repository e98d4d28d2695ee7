// The spheres of a leaf that are not certainly missed.
fn intersect_spheres(ray: PreparedRay, word: u32, before: Found) -> Found {
    var found = before;
    let first = leaf_first(word);
    let end = first + leaf_count(word);
    for (var i = first; i < end; i += 1u) {
        let sphere = bitcast<vec4<f32>>(sphere_quad(i));
        let c = chord(ray.line, v(sphere.xyz), n(sphere.w));
        if !c.misses {
            found = take_chord(ray, c, place_of(SPHERE, i), found);
        }
    }
    return found;
}
