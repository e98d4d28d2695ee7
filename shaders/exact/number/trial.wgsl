// Numbers of a width on trial: the host compares with whole numbers, and takes the time of many rounds.
struct Count {
    pairs: u32,
    rounds: u32,
    unused_0: u32,
    unused_1: u32,
}

// A number as the sum of five f32, the largest first.
struct Words { a: f32, b: f32, c: f32, d: f32, e: f32 }

// Of whole numbers x and y, what each operation gives.
struct Results {
    // x itself: it is whole only where a conversion to f32 and back is not folded away.
    conversion: Words,
    sum: Words,
    difference: Words,
    product: Words,
    quotient: Words,
    root: Words,
    // The larger less the smaller, and the size of the difference on the side that a comparison picks.
    order: Words,
    size: Words,
}

@group(0) @binding(0) var<uniform> count: Count;
@group(0) @binding(1) var<storage, read> pairs: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> results: array<Results>;

fn words(x: N) -> Words {
    let a = about(x);
    let after_a = sub(x, n(a));
    let b = about(after_a);
    let after_b = sub(after_a, n(b));
    let c = about(after_b);
    let after_c = sub(after_b, n(c));
    let d = about(after_c);
    return Words(a, b, c, d, about(sub(after_c, n(d))));
}

@compute @workgroup_size(64)
fn trial(@builtin(global_invocation_id) id: vec3<u32>) {
    // Where the time is taken more threads run than there are pairs, to keep the device busy.
    let i = id.x % count.pairs;
    // 48 bits each, whole.
    let x = add(mul(n(pairs[i].x), n(16777216.0)), n(pairs[i].y));
    let y = add(mul(n(pairs[i].z), n(16777216.0)), n(pairs[i].w));
    if id.x < count.pairs {
        results[i] = Results(
            words(x),
            words(add(x, y)),
            words(sub(x, y)),
            words(mul(x, y)),
            words(div(x, y)),
            words(root(x)),
            words(sub(larger(x, y), smaller(x, y))),
            words(size(pick(sub(x, y), sub(y, x), less(x, y)))),
        );
    }
    var sum = n(0.0);
    let small = div(x, y);
    for (var k = 0u; k < count.rounds; k += 1u) {
        sum = add(mul(sum, small), small);
        sum = sub(mul(sum, sum), small);
    }
    // Never so, but the compiler cannot know.
    if less(sum, n(-1.0e30)) {
        results[i].sum.a = 0.0;
    }
}
