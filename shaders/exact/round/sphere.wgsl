// t of a sphere's hit.
fn sphere_values(ray: PreparedRay, index: u32) -> Values {
    let sphere = bitcast<vec4<f32>>(sphere_quad(index));
    let c = chord(ray.line, v(sphere.xyz), n(sphere.w));
    let root = root_in_range(ray, c);
    let r = about(root.t);
    return Values(root.known && rounds_to(r, root.t, c.off), r, 0.0, 0.0);
}
