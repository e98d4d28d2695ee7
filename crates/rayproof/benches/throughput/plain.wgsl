// The kernel one writes first: two-child nodes of 32 bytes, both children tested from the parent, Cramer's rule, a private
// stack, plain WGSL as wgpu compiles it. A yardstick, not a part of Rayproof: nothing here is conservative.

struct Node {
    low: vec3<f32>,
    first: u32,
    high: vec3<f32>,
    count: u32,
}

struct Ray {
    origin: vec3<f32>,
    t_min: f32,
    direction: vec3<f32>,
    t_max: f32,
}

struct Hit {
    t: f32,
    u: f32,
    v: f32,
    primitive: u32,
}

@group(0) @binding(0) var<storage, read> rays: array<Ray>;
@group(0) @binding(1) var<storage, read_write> hits: array<Hit>;
@group(0) @binding(2) var<storage, read> nodes: array<Node>;
@group(0) @binding(3) var<storage, read> vertices: array<vec4<f32>>;

fn enter(node: Node, origin: vec3<f32>, inverse: vec3<f32>, t_max: f32) -> f32 {
    let a = (node.low - origin) * inverse;
    let b = (node.high - origin) * inverse;
    let low = min(a, b);
    let high = max(a, b);
    let near = max(max(low.x, low.y), max(low.z, 0.0));
    let far = min(min(high.x, high.y), min(high.z, t_max));
    return select(1e30, near, near <= far);
}

@compute @workgroup_size(64)
fn closest(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&rays) {
        return;
    }
    let ray = rays[id.x];
    let inverse = 1.0 / ray.direction;
    var hit = Hit(1e30, 0.0, 0.0, 0xffffffffu);
    var stack: array<u32, 64>;
    var top = 0u;
    var current = 0u;
    loop {
        let node = nodes[current];
        if node.count > 0u {
            for (var i = node.first; i < node.first + node.count; i += 1u) {
                let a = vertices[3u * i].xyz;
                let e1 = vertices[3u * i + 1u].xyz - a;
                let e2 = vertices[3u * i + 2u].xyz - a;
                let p = cross(ray.direction, e2);
                let inverse_determinant = 1.0 / dot(e1, p);
                let s = ray.origin - a;
                let u = dot(s, p) * inverse_determinant;
                let q = cross(s, e1);
                let v = dot(ray.direction, q) * inverse_determinant;
                let t = dot(e2, q) * inverse_determinant;
                if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= ray.t_min && t < hit.t {
                    hit = Hit(t, u, v, i);
                }
            }
        } else {
            let near_left = enter(nodes[node.first], ray.origin, inverse, hit.t);
            let near_right = enter(nodes[node.first + 1u], ray.origin, inverse, hit.t);
            if near_left < 1e30 || near_right < 1e30 {
                let left_first = near_left <= near_right;
                current = select(node.first + 1u, node.first, left_first);
                if max(near_left, near_right) < 1e30 {
                    stack[top] = select(node.first, node.first + 1u, left_first);
                    top += 1u;
                }
                continue;
            }
        }
        if top == 0u {
            break;
        }
        top -= 1u;
        current = stack[top];
    }
    hits[id.x] = hit;
}
