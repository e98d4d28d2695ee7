// Three numbers. Sums and products in the order of math.wgsl.
struct V { x: N, y: N, z: N }

fn v(p: vec3<f32>) -> V { return V(n(p.x), n(p.y), n(p.z)); }
fn minus(a: V, b: V) -> V { return V(sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)); }
fn dot_n(a: V, b: V) -> N { return add(add(mul(a.x, b.x), mul(a.y, b.y)), mul(a.z, b.z)); }

fn cross_n(a: V, b: V) -> V {
    return V(
        sub(mul(a.y, b.z), mul(a.z, b.y)),
        sub(mul(a.z, b.x), mul(a.x, b.z)),
        sub(mul(a.x, b.y), mul(a.y, b.x)),
    );
}

// The largest magnitude.
fn largest_n(a: V) -> N { return larger(larger(size(a.x), size(a.y)), size(a.z)); }
// The sum of the magnitudes.
fn manhattan(a: V) -> N { return add(add(size(a.x), size(a.y)), size(a.z)); }
