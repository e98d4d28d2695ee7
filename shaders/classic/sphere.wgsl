// Ray and sphere by the book, in f32.
//
// p(t) = e + t d in f(p) = (p - c).(p - c) - r^2 = 0 gives A t^2 + B t + C = 0 with
//   A = d.d, B = 2 d.(e - c), C = (e - c).(e - c) - r^2,
// and D = B^2 - 4 A C tells none (D < 0), one (D = 0, tangent) or two hits. -B +- sqrt(D) cancels where the root is
// small beside B, so (Numerical Recipes 5.6): q = -(B + sgn(B) sqrt(D)) / 2 with sgn(0) = 1, t1 = q / A, t2 = C / q.
// What it does not cure is the cancellation in D itself: r = 1 at distance 1e4 loses one hit in five.
fn intersect_sphere(ray: PreparedRay, center: vec3<f32>, radius: f32) -> Candidate {
    let o = ray.origin - center;
    let a = dot3(ray.direction, ray.direction);
    let b = 2.0 * dot3(ray.direction, o);
    let c = dot3(o, o) - radius * radius;
    let discriminant = b * b - 4.0 * a * c;
    if !(discriminant >= 0.0 && a > 0.0) {
        return NO_HIT;
    }
    let root = sqrt(discriminant);
    let q = -0.5 * (b + select(-root, root, b >= 0.0));
    let t1 = q / a;
    // q = 0 only where B = D = 0: a double root at 0.
    var t2 = t1;
    if q != 0.0 {
        t2 = c / q;
    }
    let near = select(t2, t1, t1 < t2);
    let far = select(t1, t2, t1 < t2);
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate(true, near, 0.0, 0.0);
    }
    return Candidate(far >= ray.t_min && far <= ray.t_max, far, 0.0, 0.0);
}
