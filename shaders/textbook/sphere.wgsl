// Ray and sphere as schoolbooks have it, in f32: t = (-B +- sqrt(B^2 - 4 A C)) / 2A with A, B, C as in classic/sphere.wgsl.
// It cancels twice: B^2 with 4 A C where the sphere is far for its size, and -B with the root where a root is small beside B.
// Here so that both can be seen and measured.
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
    let near = (-b - root) / (2.0 * a);
    let far = (-b + root) / (2.0 * a);
    if near >= ray.t_min && near <= ray.t_max {
        return Candidate(true, near, 0.0, 0.0);
    }
    return Candidate(far >= ray.t_min && far <= ray.t_max, far, 0.0, 0.0);
}
