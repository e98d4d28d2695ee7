// t of a sphere's hit.
fn sphere_values(ray: PreparedRay, index: u32) -> Values {
    let sphere = bitcast<vec4<f32>>(sphere_quad(index));
    let c = chord(ray.line, v(sphere.xyz), n(sphere.w));
    let near = sub(c.middle, c.half);
    // The near root, or the far one where the near one lies before the range.
    let is_near = !less(sub(near, c.off), n(ray.t_min));
    let is_far = less(add(near, c.off), n(ray.t_min));
    let t = pick(near, add(c.middle, c.half), is_far);
    let r = about(t);
    return Values(c.enters && (is_near || is_far) && rounds_to(r, t, c.off), r, 0.0, 0.0);
}
