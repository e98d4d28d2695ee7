// Ray and sphere by the point of closest approach, in f32.
//
// With o = e - c, a = d.d, b = d.o, the foot of the perpendicular from c onto the ray is l = o - (b/a) d, and half the
// discriminant's quarter is D = a (r^2 - l.l) (Hearn and Baker; Haines, Guenther and Akenine-Moeller, Ray Tracing Gems ch. 7).
// Its error grows with r^2 + |l|^2, not with the distance squared as that of b^2 - a c does: r = 1 keeps its hits to
// distance 1e6. The roots are q / a and c / q with q = -(b + sgn(b) sqrt(D)), sgn(0) = 1, c = o.o - r^2: no cancellation
// between -b and the root.
fn intersect_sphere(ray: PreparedRay, center: vec3<f32>, radius: f32) -> Candidate {
    let o = ray.origin - center;
    let a = dot3(ray.direction, ray.direction);
    let b = dot3(ray.direction, o);
    let l = o - (b / a) * ray.direction;
    let discriminant = a * (radius * radius - dot3(l, l));
    if !(discriminant >= 0.0) {
        return NO_HIT;
    }
    let root = sqrt(discriminant);
    let q = -(b + select(-root, root, b >= 0.0));
    let t1 = q / a;
    // q = 0 only where b = D = 0: a double root at 0.
    var t2 = t1;
    if q != 0.0 {
        t2 = (dot3(o, o) - radius * radius) / q;
    }
    let near = select(t2, t1, t1 < t2);
    let far = select(t1, t2, t1 < t2);
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate(true, near, 0.0, 0.0);
    }
    return Candidate(far >= ray.t_min && far <= ray.t_max, far, 0.0, 0.0);
}
