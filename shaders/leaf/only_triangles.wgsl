// A scene without spheres: the kernel knows of none.
fn intersect_leaf(ray: PreparedRay, word: u32, found: Found) -> Found {
    return intersect_triangles(ray, word, found);
}
