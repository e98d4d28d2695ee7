// Depth first, the nearest child next, the others kept with their keys and dropped when a nearer hit has been found.
//
// A precision says what a ray is (`PreparedRay`), what has been found so far (`Found`, `found_start`, `found_reach`, `found_finished`) and
// what a leaf adds to it (`intersect_leaf`); `node_quad` comes from the host, which knows over how many bindings the nodes are
// spread. STACK_SIZE is the host's too: what this tree needs at most, plus three, since a push writes before it knows whether
// the entry stays.

const LEAF: u32 = 0x80000000u;
// The word of no child: it ends the walk.
const DONE: u32 = 0xffffffffu;

fn load_node(index: u32) -> Node {
    let a = node_quad(index * 4u);
    let b = node_quad(index * 4u + 1u);
    let c = node_quad(index * 4u + 2u);
    return Node(
        bitcast<vec3<f32>>(a.xyz),
        bitcast<vec3<f32>>(vec3<u32>(a.w, b.xy)),
        vec3<u32>(b.zw, c.x),
        c.yzw,
        node_quad(index * 4u + 3u),
    );
}

// What has been found, in box units: never below the key of the walk's last entry, or the walk would not end there.
fn box_reach(found: Found, n: i32) -> f32 {
    return clamp(scale_by_power(found_reach(found), n), -FARTHEST, FARTHEST);
}

fn traverse(unit: UnitDirection, ray: PreparedRay) -> Found {
    let boxes = box_ray(ray.origin, unit.direction, scale_by_power(ray.t_min, ray.box_exponent));
    var found = found_start(ray);
    var s_max = box_reach(found, ray.box_exponent);

    var keys: array<f32, STACK_SIZE>;
    var words: array<u32, STACK_SIZE>;
    keys[0] = -FARTHEST;
    words[0] = DONE;
    var top = 1u;
    var current = 0u;
    loop {
        loop {
            if current >= LEAF {
                break;
            }
            let node = load_node(current);
            let order = sorted(child_keys(boxes, node, s_max));
            let slots = bitcast<vec4<u32>>(order) & vec4<u32>(3u);
            if order.x < NOT_HIT {
                keys[top] = order.w;
                words[top] = node.children[slots.w];
                top += u32(order.w < NOT_HIT);
                keys[top] = order.z;
                words[top] = node.children[slots.z];
                top += u32(order.z < NOT_HIT);
                keys[top] = order.y;
                words[top] = node.children[slots.y];
                top += u32(order.y < NOT_HIT);
                current = node.children[slots.x];
            } else {
                loop {
                    top -= 1u;
                    if keys[top] <= s_max {
                        break;
                    }
                }
                current = words[top];
            }
        }
        if current == DONE {
            break;
        }
        found = intersect_leaf(ray, current, found);
        if found_finished(found) {
            break;
        }
        s_max = box_reach(found, ray.box_exponent);
        loop {
            top -= 1u;
            if keys[top] <= s_max {
                break;
            }
        }
        current = words[top];
    }
    return found;
}
