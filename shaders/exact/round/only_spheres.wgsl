// A scene without triangles: the kernel knows of none.
fn values(ray: PreparedRay, slot: u32) -> Values {
    return sphere_values(ray, slot & ~SPHERES);
}

fn flat_number(slot: u32) -> u32 {
    return sphere_id(slot & ~SPHERES);
}
