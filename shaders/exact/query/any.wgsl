// Whether a ray hits anything: 1 or 0, or OPEN.
const ANY_HIT: bool = true;

@group(0) @binding(2) var<storage, read_write> hits: array<u32>;

// Answers a ray, or leaves it open: whether it is decided.
fn settle(index: u32) -> bool {
    let unit = unit_direction(rays[index].direction);
    let ray = prepared_ray(rays[index], unit);
    let found = traverse(unit, ray);
    let decided = ray.ordinary && found_decided(found);
    hits[index] = select(OPEN, u32(found.slot != MISS), decided);
    return decided;
}
