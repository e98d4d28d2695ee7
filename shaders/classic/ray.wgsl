// The formulas by the book take the ray as it is.
fn prepared_ray(ray: Ray, unit: UnitDirection) -> PreparedRay {
    // The scene is scaled only where boxes could not be decoded otherwise; then the ray is too.
    let n = params.scene_exponent;
    let origin = vec3<f32>(
        scale_by_power(ray.origin.x, n), scale_by_power(ray.origin.y, n), scale_by_power(ray.origin.z, n));
    return PreparedRay(
        origin, ray.direction, scale_low_end(ray.t_min, n), scale_high_end(ray.t_max, n), unit.exponent, -n);
}
