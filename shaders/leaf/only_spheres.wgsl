// A scene without triangles: the kernel knows of none.
fn intersect_leaf(ray: PreparedRay, word: u32, found: Found) -> Found {
    return intersect_spheres(ray, word, found);
}
