// A scene of triangles and spheres: bit 30 of a leaf's word tells which it holds.
const SPHERES: u32 = 0x40000000u;

fn intersect_leaf(ray: TierRay, word: u32, hit: Hit) -> Hit {
    if (word & SPHERES) == 0u {
        return intersect_triangles(ray, word, hit);
    }
    return intersect_spheres(ray, word, hit);
}
