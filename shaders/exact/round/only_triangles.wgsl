// A scene without spheres: the kernel knows of none.
fn values(ray: PreparedRay, slot: u32) -> Values {
    return triangle_values(ray.line, slot);
}

fn flat_number(slot: u32) -> u32 {
    return triangle_id(slot);
}
