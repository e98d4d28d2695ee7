// The formulas by the book take the ray as it is.
fn prepared_ray(ray: Ray, unit: UnitDirection) -> PreparedRay {
    // The scene is scaled only where boxes could not be decoded otherwise; then the ray is too.
    let n = params.scene_exponent;
    return PreparedRay(
        scale_point(ray.origin, n), ray.direction, scale_low_end(ray.t_min, n), scale_high_end(ray.t_max, n), unit.exponent, -n);
}
