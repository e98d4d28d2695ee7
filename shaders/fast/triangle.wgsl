// Ray and triangle by Cramer's rule on vertices shifted to the ray's origin, in f32, without an absolute epsilon.
//
// The determinants of [b - a, c - a, -d] [u v t]^T = e - a as Moeller and Trumbore order them, with Embree's choice of
// terms: p = a - e, n = (b - a) x (c - a), r = p x d,
//   det = n.d,  det u = r.(c - a),  det v = r.(a - b),  det t = n.p.
// t comes from the plane's normal, which on needles is better by orders of magnitude than s x e1. The signs are compared
// with that of det, and u + v <= 1 as U + V <= |det|: nothing is divided before the verdict.
fn intersect_triangle(ray: PreparedRay, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Candidate {
    let p = a - ray.origin;
    let e1 = a - b;
    let e2 = c - a;
    let n = cross3(e2, e1);
    let r = cross3(p, ray.direction);
    let determinant = dot3(n, ray.direction);
    let sign = select(1.0, -1.0, determinant < 0.0);
    let scale = sign * determinant;
    let u = sign * dot3(r, e2);
    let v = sign * dot3(r, e1);
    if !(u >= 0.0 && v >= 0.0 && u + v <= scale && scale > 0.0) {
        return NO_HIT;
    }
    let t = sign * dot3(n, p) / scale;
    let at_u = u / scale;
    let at_v = v / scale;
    let in_range = t >= ray.t_min && t <= ray.t_max;
    // What overflowed is no number, and no hit.
    return Candidate(in_range && at_u >= 0.0 && at_v >= 0.0, t, at_u, at_v);
}
