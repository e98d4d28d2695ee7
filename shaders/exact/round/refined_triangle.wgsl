// t, u and v of a triangle's hit where f32 is all there is: iterative refinement.
//
// With p = a - e, e1 = a - b, e2 = c - a (exact as sums of two f32) a hit solves p = t d + u e1 - v e2. Cramer's rule in f32
// gives x_0 = (t, u, v), then x_1 from what is left, p_1 = p - t_0 d - u_0 e1 + v_0 e2, x_2 from p_2 and so on: the hit is
// x_0 + x_1 + .. + x_k, where x_k is off by the bounds of exact/triangle.wgsl with p_k in the place of p. No digit is lost to the
// distance, nor by a small u or v. Steps end when t, u and v are settled; two do for most rays.
//
// What is left is a sum of three f32. In a step let F be max(|p|, |t| |d|), w = (|u| + |v|) edge and m = |p - t d| + w, by largest
// components; u = 2^-24: sums and products are to the nearest, or there is no transform.
// * The sums of the leading words are at most m and lose u m each.
// * The second words are those three losses, two words of at most u F, and four of at most u w: S = 2 u F + 7 u m in all. Their
//   eight sums lose at most u S each.
// * The third words are at most u^2 F and those: 8.1 u S + u^2 F in all, of which eight sums lose u each: 138 u^3 F + 455 u^3 m.
//   Used: 2^-64 F + 2^-62 m.
// * A product with the low word of e1 or e2 is rounded: u |u| |low|, and as much for v. Used: twice that.
// Beside p_k's upper words, what they leave out counts: its middle word. All that is `lost`. It moves U and V by 2 |d|_1 edge lost,
// and T by 6 edge^2 lost: as `far` larger by lost / (9 UNIT) would. Used: lost / (8 UNIT). What underflows in p_k is below 2^-118
// for a component: 2^-113 max(M, 1)^2 of U, V and T, an eighth of `tiny_triangle`.

// What u stands for in exact/triangle.wgsl, with its quotients within 2.5 ULP: 2^-23.
const ROUNDOFF: f32 = 1.1920928955078125e-7;

struct Cramer {
    direction: vec3<f32>,
    e1: vec3<f32>,
    e2: vec3<f32>,
    normal: vec3<f32>,
    // Of the determinant, 1 where that is not clear of zero.
    inverse: f32,
}

fn solved(c: Cramer, p: vec3<f32>) -> vec3<f32> {
    let r = cross3(p, c.direction);
    return vec3<f32>(dot3(c.normal, p), dot3(r, c.e2), dot3(r, c.e1)) * c.inverse;
}

// What is left of p after x.
fn lessened(p: Three, x: vec3<f32>, d: Factor, e1: Factor, e2: Factor) -> Three {
    let along = two_products(d, -x.x);
    let first = two_products(e1, -x.y);
    let second = two_products(e2, x.z);
    let a = two_sums(p.high, along.high);
    let b = two_sums(a.high, first.high);
    let c = two_sums(b.high, second.high);
    let s0 = two_sums(p.middle, a.low);
    let s1 = two_sums(s0.high, along.low);
    let s2 = two_sums(s1.high, b.low);
    let s3 = two_sums(s2.high, first.low);
    let s4 = two_sums(s3.high, e1.low * -x.y);
    let s5 = two_sums(s4.high, c.low);
    let s6 = two_sums(s5.high, second.low);
    let s7 = two_sums(s6.high, e2.low * x.z);
    let low = p.low + s0.low + s1.low + s2.low + s3.low + s4.low + s5.low + s6.low + s7.low;
    return renewed(c.high, s7.high, low);
}

// What the step from p by x may lose.
fn lost_by(p: Three, x: vec3<f32>, d: Factor, edge: f32, low: f32) -> f32 {
    let weights = abs(x.y) + abs(x.z);
    let far = max(largest(p.high), abs(x.x) * largest(d.high));
    let near = largest(p.high - x.x * d.high) + weights * edge;
    // 2^-64 and 2^-62.
    return far * 5.421010862427522e-20 + near * 2.168404344971009e-19 + weights * low * ROUNDOFF;
}

fn triangle_values(ray: PreparedRay, index: u32) -> Values {
    let qa = bitcast<vec4<f32>>(triangle_quad(index * 3u));
    let qb = bitcast<vec4<f32>>(triangle_quad(index * 3u + 1u));
    let qc = bitcast<vec4<f32>>(triangle_quad(index * 3u + 2u));
    let edge = qb.w;
    let direction = upper_words(ray.line.direction);
    let e1 = factor(two_sums(qa.xyz, -qb.xyz));
    let e2 = factor(two_sums(qc.xyz, -qa.xyz));
    let d = factor(Two(direction, vec3<f32>(0.0)));
    let from_origin = two_sums(qa.xyz, -ray.origin);

    let normal = cross3(e2.high, e1.high);
    let determinant = dot3(normal, direction);
    let tiny = ray.line.tiny_triangle.high;
    let manhattan = abs(direction.x) + abs(direction.y) + abs(direction.z);
    let side = 20.0 * ROUNDOFF * manhattan * edge;
    let off_determinant = side * edge + tiny;
    let clear = abs(determinant) > 4.0 * off_determinant;
    let cramer = Cramer(direction, e1.high, e2.high, normal, 1.0 / select(1.0, determinant, clear));

    let low = max(largest(e1.low), largest(e2.low));
    var p = Three(from_origin.high, from_origin.low, vec3<f32>(0.0));
    var x = solved(cramer, p.high);
    var total = Total(x, vec3<f32>(0.0), vec3<f32>(0.0));
    var lost = 0.0;
    var settled = false;
    for (var k = 0; k < STEPS && clear && !settled; k += 1) {
        lost += lost_by(p, x, d, edge, low);
        p = lessened(p, x, d, e1, e2);
        x = solved(cramer, p.high);
        total = plus(total, x);
        let far = largest(p.high) + (lost + largest(p.middle)) * (0.125 / ROUNDOFF);
        let weight = side * far + tiny;
        let bound = vec3<f32>(54.0 * ROUNDOFF * edge * edge * far + tiny, weight, weight);
        let relative = (bound + abs(x) * off_determinant) * (abs(cramer.inverse) * 1.375);
        settled = is_settled(total, relative + abs(x) * (8.0 * ROUNDOFF));
    }
    return Values(settled, total.high.x, total.high.y, total.high.z);
}

const STEPS: i32 = 3;

// A sum of two words, and what was left out of it, at most.
struct Total { high: vec3<f32>, low: vec3<f32>, left: vec3<f32> }

fn plus(total: Total, x: vec3<f32>) -> Total {
    let low = two_sums(total.low, x);
    let sum = two_sums(total.high, low.high);
    return Total(sum.high, sum.low, total.left + abs(low.low));
}

// Whether the leading words are what the exact numbers round to, which lie within `off` of the sum.
fn is_settled(total: Total, off: vec3<f32>) -> bool {
    let r = total.high;
    // Upward of some roundings.
    let away = (total.left + off) * 1.000001;
    let outward = select(total.low, -total.low, r < vec3<f32>(0.0));
    let far = outward + away;
    let near = away - outward;
    return settles(r.x, far.x, near.x) && settles(r.y, far.y, near.y) && settles(r.z, far.z, near.z);
}

fn upper_words(x: V) -> vec3<f32> {
    return vec3<f32>(x.x.high, x.y.high, x.z.high);
}
