// A ray's line as certificates take it: in the scaled units of the tree, with the parts of the error bounds that depend on the
// ray alone.
//
// **The arithmetic.** Every bound below holds when an operation's result is the exact one times 1 + d, |d| <= u, give or take
// what underflows: u = 2^-24 for f32 that rounds sums, products and quotients to the nearest (a square root may be 1 ULP off,
// 2 u: see sphere.wgsl); u = 2^-23 for f32 by the written rules of WGSL and Vulkan (a sum or product is one of the two
// neighbours; a quotient within 2.5 ULP; a square root as 1/inverseSqrt; any a*b+c may be fused, which only drops an error;
// either may flush subnormals, where they are operands, results or compared); UNIT for the wider numbers. First-order counts are
// given; the constants used exceed them by a fifth or more, which covers the terms in u^2 and the roundings in the bounds
// themselves.
//
// **The domain.** A ray is `ordinary` when the scene is plain (scaling cost no bit; coordinates and radii are 0 or within 2^-100
// and 2^25), its scaled numbers are 0 or above 2^-100, and |o| + M < 2^55 (|o| the largest component, M the scene's size). Then no
// difference of two coordinates underflows (it is 0 or above 2^-124), nothing overflows, and what products lose to underflow is
// below 2^-120 max(reach, 1) max(M, 1) for a triangle and 2^-120 max(reach, 1)^2 for a sphere, reach = |o| + M: `tiny_*` are 2^10
// and 2^20 times that. Other rays are left open.
struct Line {
    origin: V,
    direction: V,
    // 20 u (|d_x| + |d_y| + |d_z|).
    side_error: N,
    // 54 u.
    plane_error: N,
    // 8 u.
    round_error: N,
    tiny_triangle: N,
    // What no bound of a triangle's t is below: 2^-100. So t - off is never subnormal, and no device takes it for 0.
    tiny_t: N,
    // 1 / d.d.
    inverse_a: N,
    // 28 u, and 28 u / |d|.
    foot_error: N,
    middle_error: N,
    // 12 u.
    root_error: N,
    tiny_sphere: N,
}

fn line(origin: vec3<f32>, direction: vec3<f32>) -> Line {
    let d = v(direction);
    let reach = max(largest(origin) + params.scene_size, 1.0);
    let inverse_a = div(n(1.0), dot_n(d, d));
    return Line(
        v(origin),
        d,
        mul(manhattan(d), n(20.0 * UNIT)),
        n(54.0 * UNIT),
        n(8.0 * UNIT),
        n(7.703719777548943e-34 * reach * max(params.scene_size, 1.0)), // 2^-110
        n(7.888609052210118e-31), // 2^-100
        inverse_a,
        n(28.0 * UNIT),
        mul(root(inverse_a), n(28.0 * UNIT)),
        n(12.0 * UNIT),
        n(7.888609052210118e-31 * reach * reach), // 2^-100
    );
}
