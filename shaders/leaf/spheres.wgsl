// The spheres of a leaf: one quad each, centre and radius, and the flat number in a list of its own.
fn intersect_spheres(ray: PreparedRay, word: u32, before: Hit) -> Hit {
    var hit = before;
    let first = leaf_first(word);
    let end = first + leaf_count(word);
    for (var i = first; i < end; i += 1u) {
        let sphere = bitcast<vec4<f32>>(sphere_quad(i));
        hit = closer(intersect_sphere(ray, sphere.xyz, sphere.w), sphere_id(i), hit);
    }
    return hit;
}
