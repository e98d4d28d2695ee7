// The triangles of a leaf: three quads each, the flat number beside the first vertex.
fn intersect_triangles(ray: PreparedRay, word: u32, before: Hit) -> Hit {
    var hit = before;
    let first = leaf_first(word) * 3u;
    let end = first + leaf_count(word) * 3u;
    for (var i = first; i < end; i += 3u) {
        let a = triangle_quad(i);
        let b = triangle_quad(i + 1u);
        let c = triangle_quad(i + 2u);
        let found = intersect_triangle(
            ray,
            bitcast<vec3<f32>>(a.xyz),
            bitcast<vec3<f32>>(b.xyz),
            bitcast<vec3<f32>>(c.xyz),
        );
        hit = closer(found, a.w, hit);
    }
    return hit;
}
