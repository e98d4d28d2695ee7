// A ray of the precision `exact`: scaled by powers of two, exactly, as that of the precision `fast`.
struct PreparedRay {
    origin: vec3<f32>,
    t_min: f32,
    t_max: f32,
    // Box units are those of t.
    box_exponent: i32,
    // What is returned: t 2^out_exponent.
    out_exponent: i32,
    // Whether the bounds hold: see line.wgsl.
    ordinary: bool,
    line: Line,
}

// Whether scaling may have cost a bit: a number that is neither zero nor well above the subnormals.
fn lost(given: f32, scaled: f32) -> bool {
    return !is_zero(given) && abs(scaled) < 7.888609052210118e-31; // 2^-100
}

fn lost_any(given: vec3<f32>, scaled: vec3<f32>) -> bool {
    return lost(given.x, scaled.x) || lost(given.y, scaled.y) || lost(given.z, scaled.z);
}

fn prepared_ray(ray: Ray, unit: UnitDirection) -> PreparedRay {
    let m = params.scene_exponent;
    let e = unit.exponent + m;
    let origin = scale_point(ray.origin, m);
    let t_min = clamp(scale_by_power(ray.t_min, e), -FARTHEST, FARTHEST);
    let t_max = clamp(scale_by_power(ray.t_max, e), -FARTHEST, FARTHEST);
    let ordinary = largest(origin) + params.scene_size < 3.602879701896397e16 // 2^55
        && !lost_any(ray.origin, origin)
        && !lost_any(ray.direction, unit.direction)
        && !lost(ray.t_min, t_min)
        && !lost(ray.t_max, t_max);
    return PreparedRay(origin, t_min, t_max, 0, -e, ordinary, line(origin, unit.direction));
}
