// The closest hit of a ray: for now the place of its primitive.
const ANY_HIT: bool = false;

@group(0) @binding(2) var<storage, read_write> hits: array<vec4<u32>>;

// Answers a ray, or leaves it open: whether it is decided.
fn settle(index: u32) -> bool {
    let unit = unit_direction(rays[index].direction);
    let ray = prepared_ray(rays[index], unit);
    let found = traverse(unit, ray);
    let decided = ray.ordinary && found_decided(found);
    // t of a miss is infinite.
    hits[index] = vec4<u32>(0x7f800000u, 0u, 0u, select(OPEN, found.slot, decided));
    return decided;
}
