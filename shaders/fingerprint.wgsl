// What the device's f32 arithmetic does: the host compares each word with IEEE's answer, bit for bit.

struct Count {
    pairs: u32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}

// What is measured, in the order of a result.
struct Results {
    sum: f32,
    // What rounding lost in the sum (Knuth's TwoSum): 0 where the compiler simplified a + b - a.
    sum_error: f32,
    product: f32,
    // What rounding lost in the product (Dekker's TwoProduct, halves by mask): needs no fused operation.
    product_error: f32,
    // x y - 1.0000001 (y x): another number where one of the products is fused with the difference.
    contracted: f32,
    quotient: f32,
    root: f32,
    // 0 where fma rounds twice.
    fma_error: f32,
    // Bit 0: x < y, bit 1: x >= y, bit 2: !(x >= y).
    comparisons: u32,
    // x 2^-64, bit for bit: subnormal where x is small.
    scaled: f32,
    // x 2^100: 0 where a subnormal x is flushed before it is used.
    lifted: f32,
    // One of the two as it is: a subnormal must pass through a choice, since integers take it from there.
    moved: f32,
    // x 1 and x + 0, which a compiler may fold.
    times_one: f32,
    plus_zero: f32,
    // 4096 x without its fraction, and the bits of x's fraction as a number.
    whole: f32,
    fraction: f32,
    absolute: f32,
    least: f32,
    most: f32,
    selected: f32,
    // x y + y beside y x + x in a vector: the first of them.
    packed: f32,
}

@group(0) @binding(0) var<uniform> count: Count;
@group(0) @binding(1) var<storage, read> pairs: array<vec2<f32>>;
@group(0) @binding(2) var<storage, read_write> results: array<Results>;

fn high(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

@compute @workgroup_size(64)
fn fingerprint(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if i >= count.pairs {
        return;
    }
    let x = pairs[i].x;
    let y = pairs[i].y;
    let sum = x + y;
    let part = sum - x;
    let product = x * y;
    let xh = high(x);
    let xl = x - xh;
    let yh = high(y);
    let yl = y - yh;
    results[i] = Results(
        sum,
        (x - (sum - part)) + (y - part),
        product,
        ((xh * yh - product) + xh * yl + xl * yh) + xl * yl,
        x * y - (y * x) * 1.0000001,
        x / y,
        sqrt(abs(x)),
        fma(x, y, -(x * y)),
        u32(x < y) | (u32(x >= y) << 1u) | (u32(!(x >= y)) << 2u),
        x * 5.421010862427522e-20,
        x * 1.2676506002282294e30,
        select(y, x, count.pairs > 0u),
        x * 1.0,
        x + 0.0,
        f32(i32(x * 4096.0)),
        f32(bitcast<u32>(x) & 0x007fffffu),
        abs(x),
        min(x, y),
        max(x, y),
        select(x, y, x < y),
        (vec2<f32>(x, y) * vec2<f32>(y, x) + vec2<f32>(y, x)).x,
    );
}
