// Ray and triangle as in fast/triangle.wgsl, in numbers of twice the width; t, u and v are rounded at the end.
fn intersect_triangle(ray: PreparedRay, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Candidate {
    let d = v(ray.direction);
    let p = minus(v(a), v(ray.origin));
    let e1 = minus(v(a), v(b));
    let e2 = minus(v(c), v(a));
    let normal = cross_n(e2, e1);
    let r = cross_n(p, d);
    let determinant = dot_n(normal, d);
    let negative = less(determinant, n(0.0));
    let scale = signed(determinant, negative);
    let weight_u = signed(dot_n(r, e2), negative);
    let weight_v = signed(dot_n(r, e1), negative);
    let outside = less(weight_u, n(0.0)) || less(weight_v, n(0.0)) || less(scale, add(weight_u, weight_v));
    if outside || !less(n(0.0), scale) {
        return NO_HIT;
    }
    let t = to_f32(div(signed(dot_n(normal, p), negative), scale));
    let at_u = to_f32(div(weight_u, scale));
    let at_v = to_f32(div(weight_v, scale));
    let in_range = t >= ray.t_min && t <= ray.t_max;
    // What overflowed is no number, and no hit.
    return Candidate(in_range && at_u >= 0.0 && at_v >= 0.0, t, at_u, at_v);
}

fn signed(x: N, negative: bool) -> N {
    return pick(x, sub(n(0.0), x), negative);
}
