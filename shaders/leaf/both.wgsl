// A scene of triangles and spheres.
fn intersect_leaf(ray: PreparedRay, word: u32, found: Found) -> Found {
    if (word & SPHERES) == 0u {
        return intersect_triangles(ray, word, found);
    }
    return intersect_spheres(ray, word, found);
}
