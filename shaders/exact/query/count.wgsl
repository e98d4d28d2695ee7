// How often a ray crosses the surface, or OPEN.
@group(0) @binding(2) var<storage, read_write> hits: array<u32>;

// Answers a ray, or leaves it open: whether it is decided.
fn settle(index: u32) -> bool {
    let unit = unit_direction(rays[index].direction);
    let ray = prepared_ray(rays[index], unit);
    let found = traverse(unit, ray);
    let decided = ray.ordinary && !found.open;
    hits[index] = select(OPEN, found.count, decided);
    return decided;
}
