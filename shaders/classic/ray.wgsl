// The formulas by the book take the ray as it is.
struct TierRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
    t_min: f32,
    t_max: f32,
    // Box units: s = t 2^box_exponent.
    box_exponent: i32,
    // What is returned: t 2^out_exponent.
    out_exponent: i32,
}

fn tier_ray(ray: Ray, unit: UnitDirection) -> TierRay {
    // The scene is scaled only where boxes could not be decoded otherwise; then the ray is too.
    let n = params.scene_exponent;
    let origin = vec3<f32>(
        scale_by_power(ray.origin.x, n), scale_by_power(ray.origin.y, n), scale_by_power(ray.origin.z, n));
    return TierRay(
        origin, ray.direction, scale_low_end(ray.t_min, n), scale_high_end(ray.t_max, n), unit.exponent, -n);
}
