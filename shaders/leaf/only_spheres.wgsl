// A scene without triangles: the kernel knows of none.
fn intersect_leaf(ray: TierRay, word: u32, hit: Hit) -> Hit {
    return intersect_spheres(ray, word, hit);
}
