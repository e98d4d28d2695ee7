// The hit of a ray whose primitive is known.
@group(0) @binding(2) var<storage, read_write> hits: array<vec4<u32>>;

// Writes the hit; whether its numbers could be rounded. A t that is not a normal number is left to the CPU.
fn write_hit(index: u32, slot: u32) -> bool {
    let ray = prepared_ray(rays[index], unit_direction(rays[index].direction));
    let found = values(ray, slot);
    let t = scale_by_power(found.t, ray.out_exponent);
    if !(found.settled && abs(t) >= SMALLEST_NORMAL && abs(t) <= 3.4028234663852886e38) {
        return false;
    }
    hits[index] = vec4<u32>(bitcast<u32>(t), bitcast<u32>(found.u), bitcast<u32>(found.v), flat_number(slot));
    return true;
}
