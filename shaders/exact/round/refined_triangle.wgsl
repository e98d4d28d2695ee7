// t, u and v of a triangle's hit where f32 is all there is: iterative refinement.
//
// With p = a - e, e1 = a - b, e2 = c - a (exact as sums of two f32) a hit solves p = t d + u e1 - v e2. Cramer's rule in f32
// gives x_0 = (t, u, v), then x_1 from what is left, p_1 = p - t_0 d - u_0 e1 + v_0 e2, and x_2 from p_2: the hit is
// x_0 + x_1 + x_2, where x_2 is off by the bounds of exact/triangle.wgsl with p_2 in the place of p. No digit is lost to the
// distance, nor by a small u or v.
//
// What is left is a sum of three f32. Let m be |p| + |t| |d| + (|u| + |v|) edge of a step, by largest components; u = 2^-24:
// sums and products are to the nearest, or there is no transform.
// * The four leading terms are at most m, their sums 4 m at most, and lose 2, 3 and 4 m u.
// * The second words (the three losses, four words of at most m u, and two products of low words of at most m u) are less than
//   16 m u in all; their eight sums lose at most 16 m u^2 each.
// * The third words are at most 2 m u^2 and those: 130 m u^2 in all, of which nine sums lose 9 130 m u^3: under 2^-61 m.
// * A product with the low word of e1 or e2 is rounded: u |u| |low|, and as much for v.
// Used for both steps: 2^-60 m, and 2 u (|u| + |v|) |low|. Beside p_2's upper words, what they leave out counts: its middle word.
// All that is `lost`. It moves U and V by 2 |d|_1 edge lost, and T by 6 edge^2 lost: as `far` larger by lost / (9 UNIT) would.
// Used: lost / (8 UNIT). What underflows in p_1 and p_2 is below 2^-119 for a component: 2^-114 max(M, 1)^2 of U, V and T, a
// sixteenth of `tiny_triangle`.

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
    let terms = largest(p.high) + abs(x.x) * largest(d.high) + weights * edge;
    return terms * 8.673617379884035e-19 + weights * low * ROUNDOFF; // 2^-60
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
    let p0 = Three(from_origin.high, from_origin.low, vec3<f32>(0.0));

    let normal = cross3(e2.high, e1.high);
    let determinant = dot3(normal, direction);
    let tiny = ray.line.tiny_triangle.high;
    let manhattan = abs(direction.x) + abs(direction.y) + abs(direction.z);
    let side = 20.0 * ROUNDOFF * manhattan * edge;
    let off_determinant = side * edge + tiny;
    let clear = abs(determinant) > 4.0 * off_determinant;
    let cramer = Cramer(direction, e1.high, e2.high, normal, 1.0 / select(1.0, determinant, clear));

    let x0 = solved(cramer, p0.high);
    let p1 = lessened(p0, x0, d, e1, e2);
    let x1 = solved(cramer, p1.high);
    let p2 = lessened(p1, x1, d, e1, e2);
    let x2 = solved(cramer, p2.high);

    let low = max(largest(e1.low), largest(e2.low));
    let lost = lost_by(p0, x0, d, edge, low) + lost_by(p1, x1, d, edge, low) + largest(p2.middle);
    let far = largest(p2.high) + lost * (0.125 / ROUNDOFF);
    let weight = side * far + tiny;
    let bound = vec3<f32>(54.0 * ROUNDOFF * edge * edge * far + tiny, weight, weight);
    let relative = (bound + abs(x2) * off_determinant) * (abs(cramer.inverse) * 1.375);
    return rounded_sums(x0, x1, x2, relative + abs(x2) * (8.0 * ROUNDOFF), clear);
}

// The sums rounded, where each is within `off`.
fn rounded_sums(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, off: vec3<f32>, clear: bool) -> Values {
    let first = two_sums(a, b);
    let second = two_sums(first.low, c);
    let sum = two_sums(first.high, second.high);
    let r = sum.high;
    // The exact number lies no farther from r; upward of three roundings.
    let away = (abs(sum.low) + abs(second.low) + off) * 1.000001;
    let settled = clear && settles(r.x, away.x) && settles(r.y, away.y) && settles(r.z, away.z);
    return Values(settled, r.x, r.y, r.z);
}

fn upper_words(x: V) -> vec3<f32> {
    return vec3<f32>(x.x.high, x.y.high, x.z.high);
}

fn triangle_id(index: u32) -> u32 {
    return triangle_quad(index * 3u).w;
}
