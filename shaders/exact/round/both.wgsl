// A scene of triangles and spheres.
fn values(ray: PreparedRay, slot: u32) -> Values {
    if (slot & SPHERES) == 0u {
        return triangle_values(ray.line, slot);
    }
    return sphere_values(ray, slot & ~SPHERES);
}

fn flat_number(slot: u32) -> u32 {
    if (slot & SPHERES) == 0u {
        return triangle_id(slot);
    }
    return sphere_id(slot & ~SPHERES);
}
