// Ray and triangle by the book, in f32.
//
// The plane a + u (b - a) + v (c - a) set equal to e + t d is the system
//   [b - a, c - a, -d] [u v t]^T = e - a,
// solved by Cramer's rule with determinants as triple products. v outside [0, 1] is rejected first, then u outside
// [0, 1 - v], so that most misses pay for one numerator.
fn intersect_triangle(ray: PreparedRay, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Candidate {
    let e1 = b - a;
    let e2 = c - a;
    let s = ray.origin - a;
    // det [e1, e2, -d] = d . (e2 x e1)
    let p = cross3(e2, e1);
    let determinant = dot3(ray.direction, p);
    if determinant == 0.0 {
        return NO_HIT;
    }
    // det [e1, s, -d] = e1 . (d x s)
    let m = cross3(ray.direction, s);
    let v = dot3(e1, m) / determinant;
    if !(v >= 0.0 && v <= 1.0) {
        return NO_HIT;
    }
    // det [s, e2, -d] = -e2 . (d x s)
    let u = -dot3(e2, m) / determinant;
    if !(u >= 0.0 && u <= 1.0 - v) {
        return NO_HIT;
    }
    // det [e1, e2, s] = -s . (e2 x e1)
    let t = -dot3(s, p) / determinant;
    return Candidate(t >= ray.t_min && t <= ray.t_max, t, u, v);
}
