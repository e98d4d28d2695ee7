// The ray scaled by powers of two, exactly: the origin as the scene was (params.scene_exponent), the direction so that
// 2 <= max|d_i| < 4. With p = e + t d, e' = 2^m e and d' = 2^-k d it is p' = e' + t' d' for t' = t 2^(k + m): roots are the
// same numbers but for a power of two. It takes |d| from 1e-38 to 1e38, scenes from 1e-30 to 1e30, and origins up to 2^60
// scene sizes away, without overflow of a product of three lengths.
fn prepared_ray(ray: Ray, unit: UnitDirection) -> PreparedRay {
    let m = params.scene_exponent;
    let n = unit.exponent + m;
    let origin = scale_point(ray.origin, m);
    return PreparedRay(origin, unit.direction, scale_low_end(ray.t_min, n), scale_high_end(ray.t_max, n), 0, -n);
}
