// In the place of bvh/traverse.wgsl: no tree, every ray is tested with every primitive. For measuring what formulas cost by
// themselves. NODE_COUNT is the host's.

const LEAF: u32 = 0x80000000u;
// The word of no child.
const NONE: u32 = 0xffffffffu;

fn traverse(unit: UnitDirection, ray: PreparedRay) -> Found {
    var found = found_start(ray);
    for (var i = 0u; i < NODE_COUNT; i += 1u) {
        let children = node_quad(i * 4u + 3u);
        for (var k = 0u; k < 4u; k += 1u) {
            let word = children[k];
            if word >= LEAF && word != NONE {
                found = intersect_leaf(ray, word, found);
            }
        }
    }
    return found;
}
