// Ray and sphere as in fast/sphere.wgsl, in numbers of twice the width; the roots are rounded at the end.
fn intersect_sphere(ray: PreparedRay, center: vec3<f32>, radius: f32) -> Candidate {
    let d = v(ray.direction);
    let o = minus(v(ray.origin), v(center));
    let a = dot_n(d, d);
    let b = dot_n(d, o);
    let foot = div(b, a);
    let l = V(sub(o.x, mul(foot, d.x)), sub(o.y, mul(foot, d.y)), sub(o.z, mul(foot, d.z)));
    let r2 = mul(n(radius), n(radius));
    let discriminant = mul(a, sub(r2, dot_n(l, l)));
    if less(discriminant, n(0.0)) {
        return NO_HIT;
    }
    let h = root(discriminant);
    let q = sub(n(0.0), pick(add(b, h), sub(b, h), less(b, n(0.0))));
    let t1 = to_f32(div(q, a));
    // q = 0 only where b = D = 0: a double root at 0.
    var t2 = t1;
    if less(q, n(0.0)) || less(n(0.0), q) {
        t2 = to_f32(div(sub(dot_n(o, o), r2), q));
    }
    let near = select(t2, t1, t1 < t2);
    let far = select(t1, t2, t1 < t2);
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate(true, near, 0.0, 0.0);
    }
    return Candidate(far >= ray.t_min && far <= ray.t_max, far, 0.0, 0.0);
}
