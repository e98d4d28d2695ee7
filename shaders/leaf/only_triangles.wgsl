// A scene without spheres: the kernel knows of none.
fn intersect_leaf(ray: TierRay, word: u32, hit: Hit) -> Hit {
    return intersect_triangles(ray, word, hit);
}
