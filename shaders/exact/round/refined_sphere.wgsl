// t of a sphere's hit in pairs of f32: once more from where the first t is, if that was not enough.
//
// With t_0 the nearest f32 of what round/sphere.wgsl finds, x = (e - c) + t_0 d is the point there as seen from the centre: the
// difference and the product are exact as pairs, and their sum is off by u of itself. The roots from x on are off by the bounds
// of exact/sphere.wgsl with |x|, about the radius, in the place of the distance; t = t_0 + delta by u |t| more.
fn sphere_values(ray: PreparedRay, index: u32) -> Values {
    let sphere = bitcast<vec4<f32>>(sphere_quad(index));
    let center = v(sphere.xyz);
    let c = chord(ray.line, center, n(sphere.w));
    let root = root_in_range(ray, c);
    let r = about(root.t);
    if !root.known || rounds_to(r, root.t, c.off) {
        return Values(root.known, r, 0.0, 0.0);
    }
    var line = ray.line;
    line.origin = moved(minus(ray.line.origin, center), ray.line.direction, n(r));
    let again = chord(line, v(vec3<f32>(0.0)), n(sphere.w));
    let delta = pick(sub(again.middle, again.half), add(again.middle, again.half), root.is_far);
    let closer = add(n(r), delta);
    let rounded = about(closer);
    let off = add(again.off, mul(size(closer), n(UNIT)));
    return Values(again.enters && rounds_to(rounded, closer, off), rounded, 0.0, 0.0);
}

fn moved(o: V, d: V, t: N) -> V {
    return V(add(o.x, mul(d.x, t)), add(o.y, mul(d.y, t)), add(o.z, mul(d.z, t)));
}
