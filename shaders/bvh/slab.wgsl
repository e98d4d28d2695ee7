// Ray against the four boxes of a node: conservative, without an infinity or a NaN.
//
// Lengths below are in box units: the ray is p(s) = o + s d with the direction scaled by a power of two (exactly) so
// that 2 <= max|d_i| < 4. M is params.scene_size: every box lies within [-M, M]. For a point of the scene,
// |s| <= (|o| + M) / 2 =: S/2 with |.| the largest component and S = |o| + M.
//
// 1. A plane at x (exact: see the node) gives s = (x - o) (1/d). Under WGSL's own rules the difference is off by
//    2^-23 relative (either neighbour), the reciprocal by 2.5 ULP, the product by 2^-23: 4.5 2^-23 in all, and
//    less under IEEE. The key of a child loses its two lowest bits to the slot: 3 ULP more, 3 2^-23. Widening by
//    16 2^-23 relative covers 7.5 2^-23 and the rounding of the widening itself (2^-23).
// 2. A position that underflows (a subnormal flushed or rounded when the ray was scaled, a difference flushed) is off
//    by less than 2^-125, which |d_i| >= 2^-62 makes 2^-63 in s. Scaling keeps M at 2^-20 or more, so `slack`, 2^-40 M,
//    added to both ends, covers it. (The formulas by the book run unscaled: there M may be less, and a device that
//    flushes subnormals is promised nothing.)
// 3. An axis with |d_i| < 2^-62 hardly moves: |s d_i| < 2^-63 S over the whole scene. It is given d_i = 2^-62 and the
//    slab is widened by w on both sides, w >= 2^-52 S after rounding. A ray whose point lies in the slab starts within
//    2^-63 S of it, so its widened interval reaches (2^-52 - 2^-63) S 2^62 > S both ways and holds every s of the scene.
// 4. Beyond |o| = 2^126 a coordinate is clamped, and s counts as a miss beyond 2^127: documented limits of range.

const SMALLEST_DIRECTION: f32 = 2.168404344971009e-19; // 2^-62
const FARTHEST: f32 = 1.7014118346046923e38; // 2^127
const NARROW: f32 = 0.9999980926513672; // 1 - 16 2^-23
const WIDEN: f32 = 1.0000019073486328; // 1 + 16 2^-23
// The key of a child that is not hit; every real key is at most 2^127.
const NOT_HIT: f32 = 3.0e38;

struct Node {
    origin: vec3<f32>,
    step: vec3<f32>,
    low: vec3<u32>,
    high: vec3<u32>,
    children: vec4<u32>,
}

struct BoxRay {
    // What the planes met first on each axis, and those met last, are measured from: the origin, widened on axes that hardly
    // move.
    from_near: vec3<f32>,
    from_far: vec3<f32>,
    // On which axes the high plane is met first.
    back: vec3<bool>,
    inverse: vec3<f32>,
    s_min: f32,
    slack: f32,
}

// A direction with 2 <= max|d_i| < 4, and the exponent n such that s = t 2^n.
struct UnitDirection {
    direction: vec3<f32>,
    exponent: i32,
}

fn unit_direction(direction: vec3<f32>) -> UnitDirection {
    var d = direction;
    var exponent = 0;
    if largest(d) < 7.888609052210118e-31 { // 2^-100: lift subnormals, exactly
        d = scale_point(d, 100);
        exponent = -100;
    }
    let shift = exponent_of(largest(d)) - 1;
    // Two below the largest exponent at least: 2^-shift is normal.
    return UnitDirection(d * power_of_two(-shift), exponent + shift);
}

fn box_ray(origin: vec3<f32>, direction: vec3<f32>, s_min: f32) -> BoxRay {
    let o = clamp(origin, vec3<f32>(-8.507059173023462e37), vec3<f32>(8.507059173023462e37)); // 2^126
    let reach = largest(o) + params.scene_size;
    let still = abs(direction) < vec3<f32>(SMALLEST_DIRECTION);
    let moved = select(direction, vec3<f32>(SMALLEST_DIRECTION), still);
    // At least 2^-50 S, and at least 2^-22 |o_i| so that the sum is another number than o_i.
    let slack = max(vec3<f32>(reach * 8.881784197001252e-16), abs(o) * 2.384185791015625e-7);
    let from_low = select(o, o + slack, still);
    let from_high = select(o, o - slack, still);
    let back = moved < vec3<f32>(0.0);
    return BoxRay(
        select(from_low, from_high, back),
        select(from_high, from_low, back),
        back,
        vec3<f32>(1.0) / moved,
        s_min,
        params.scene_size * 9.094947017729282e-13, // 2^-40
    );
}

// Four planes on one axis, decoded exactly: byte k of the word is the plane of child k.
fn planes(word: u32, step: f32, origin: f32) -> vec4<f32> {
    let q = vec4<u32>(word, word >> 8u, word >> 16u, word >> 24u) & vec4<u32>(255u);
    return vec4<f32>(q) * step + origin;
}

// For each child, a key to sort and to cull by: where the ray enters its box, at most, with the child's slot in the two
// lowest bits, which makes keys of one node differ; NOT_HIT where the box is not met between s_min and s_max.
//
// The direction's sign tells which plane of an axis is met first: low <= high, and rounding keeps order. Along the axis of
// max|d_i| nothing overflows, so `enter` is never -inf and `leave` never inf; elsewhere an infinity is a miss.
fn child_keys(ray: BoxRay, node: Node, s_max: f32) -> vec4<f32> {
    let first = select(node.low, node.high, ray.back);
    let last = select(node.high, node.low, ray.back);
    let enter_x = (planes(first.x, node.step.x, node.origin.x) - ray.from_near.x) * ray.inverse.x;
    let enter_y = (planes(first.y, node.step.y, node.origin.y) - ray.from_near.y) * ray.inverse.y;
    let enter_z = (planes(first.z, node.step.z, node.origin.z) - ray.from_near.z) * ray.inverse.z;
    let leave_x = (planes(last.x, node.step.x, node.origin.x) - ray.from_far.x) * ray.inverse.x;
    let leave_y = (planes(last.y, node.step.y, node.origin.y) - ray.from_far.y) * ray.inverse.y;
    let leave_z = (planes(last.z, node.step.z, node.origin.z) - ray.from_far.z) * ray.inverse.z;
    let enter = max(max(enter_x, enter_y), enter_z);
    let leave = min(min(leave_x, leave_y), leave_z);
    // Earlier and later by the pad: the factor that widens depends on the sign.
    let near = enter * select(vec4<f32>(WIDEN), vec4<f32>(NARROW), enter > vec4<f32>(0.0)) - ray.slack;
    let far = leave * select(vec4<f32>(NARROW), vec4<f32>(WIDEN), leave > vec4<f32>(0.0)) + ray.slack;
    let met = (near <= far) & (near <= vec4<f32>(s_max)) & (far >= vec4<f32>(ray.s_min));
    let there = node.children != vec4<u32>(MISS);
    // Where a device compares subnormals as 0, slots beside a zero would all be one key: it is moved down to -2^-100.
    let clear = select(near, vec4<f32>(-7.888609052210118e-31), abs(near) < vec4<f32>(7.888609052210118e-31));
    let key = bitcast<vec4<f32>>((bitcast<vec4<u32>>(clear) & vec4<u32>(0xfffffffcu)) | vec4<u32>(0u, 1u, 2u, 3u));
    return select(vec4<f32>(NOT_HIT), key, met & there);
}

// The keys in rising order, by a network of five comparisons. They differ, so every sort gives this order.
fn sorted(keys: vec4<f32>) -> vec4<f32> {
    let low = min(keys.xz, keys.yw);
    let high = max(keys.xz, keys.yw);
    let first = min(low.x, low.y);
    let last = max(high.x, high.y);
    let a = max(low.x, low.y);
    let b = min(high.x, high.y);
    return vec4<f32>(first, min(a, b), max(a, b), last);
}
