// What is certain of a line and a triangle, by the signs of its edge functions.
//
// With p = a - e, e1 = a - b, e2 = c - a, n = e2 x e1 and r = p x d (the precision `fast` has the same):
//   det = n.d,  U = r.e2 = u det,  V = r.e1 = v det,  W = det - U - V = (1 - u - v) det,  T = n.p = t det.
// The line passes through the inside when U, V and W have one sign, and misses the closed triangle when two have opposite ones.
//
// Bounds, to first order in u (see line.wgsl); far = |p|, edge = max(|e1|, |e2|) by largest components, |d|_1 the sum:
// * p, e1, e2: u of each component.
// * r_i = p_j d_k - p_k d_j: p u, the products u, the difference u: 3 u (|p_j d_k| + |p_k d_j|).
// * U, V: r 3 u, e2 u, the products u, the sums 2 u: 7 u sum_i (|p_j d_k| + |p_k d_j|) |e_i| <= 14 u |d|_1 far edge.
// * det: n has 4 u (|e2_j e1_k| + |e2_k e1_j|), the products u, the sums 2 u: 14 u |d|_1 edge^2.
// * W: the bounds of its three terms, and u |det - U| + u |W| <= u |d|_1 (4 edge^2 + 6 far edge) for the two differences: in
//   all u |d|_1 (34 far edge + 18 edge^2).
//   Used: 20 u |d|_1 far edge for U and V, 20 u |d|_1 edge^2 for det, twice the one plus the other for W.
// * T: n 4 u, p u, the products u, the sums 2 u: 8 u sum_i 2 edge^2 |p_i| <= 48 u edge^2 far. Used: 54 =: B_T.
// * t: with q = T / det of the computed two, |q - t| <= (B_T + |t| B_det) / |det|; where |det| > 4 B_det this is at most
//   4/3 (B_T + |q| B_det) / |det|. The reciprocal (2.5 u) and the product (u) add 3.5 u |q|, the two ends of the interval u each.
//   Used: 1.375 and 8 u. u and v likewise, with the bound of U and V.
// The reciprocal of a det that is clear of zero (> 2^-16 edge^2 or so) never makes t overflow: T <= 6 edge^2 far.
struct Corners { a: V, b: V, c: V, edge: N }

struct Sides {
    p: V,
    normal: V,
    far: N,
    u: N,
    v: N,
    w: N,
    determinant: N,
    // The bound of u and v, that of w, and that of the determinant.
    bound: N,
    bound_w: N,
    bound_determinant: N,
}

fn sides(ray: Line, t: Corners) -> Sides {
    let p = minus(t.a, ray.origin);
    let e1 = minus(t.a, t.b);
    let e2 = minus(t.c, t.a);
    let normal = cross_n(e2, e1);
    let r = cross_n(p, ray.direction);
    let determinant = dot_n(normal, ray.direction);
    let u = dot_n(r, e2);
    let v = dot_n(r, e1);
    let w = sub(sub(determinant, u), v);
    let far = largest_n(p);
    let side = mul(ray.side_error, t.edge);
    let bound = add(mul(side, far), ray.tiny_triangle);
    let bound_determinant = add(mul(side, t.edge), ray.tiny_triangle);
    let bound_w = add(add(bound, bound), bound_determinant);
    return Sides(p, normal, far, u, v, w, determinant, bound, bound_w, bound_determinant);
}

// Two edge functions certainly have opposite signs.
fn triangle_misses(s: Sides) -> bool {
    let low = smaller(add(smaller(s.u, s.v), s.bound), add(s.w, s.bound_w));
    let high = larger(sub(larger(s.u, s.v), s.bound), sub(s.w, s.bound_w));
    return less(low, n(0.0)) && less(n(0.0), high);
}

// All three certainly have one sign.
fn triangle_crosses(s: Sides) -> bool {
    let low = smaller(sub(smaller(s.u, s.v), s.bound), sub(s.w, s.bound_w));
    let high = larger(add(larger(s.u, s.v), s.bound), add(s.w, s.bound_w));
    return less(n(0.0), low) || less(high, n(0.0));
}

// A number and what it may be off by; `clear` where the determinant is clear of zero, and only then either means anything.
struct Estimate { clear: bool, value: N, off: N }

fn quotient(ray: Line, s: Sides, numerator: N, bound: N) -> Estimate {
    let clear = less(mul(s.bound_determinant, n(4.0)), size(s.determinant));
    let inverse = div(n(1.0), pick(n(1.0), s.determinant, clear));
    let value = mul(numerator, inverse);
    let relative = mul(mul(add(bound, mul(size(value), s.bound_determinant)), size(inverse)), n(1.375));
    return Estimate(clear, value, add(add(relative, mul(size(value), ray.round_error)), ray.tiny_t));
}

fn plane_t(ray: Line, s: Sides, edge: N) -> Estimate {
    let bound = add(mul(mul(mul(ray.plane_error, edge), edge), s.far), ray.tiny_triangle);
    return quotient(ray, s, dot_n(s.normal, s.p), bound);
}

// The triangle of an index: three quads, with the flat number beside the first vertex and `edge` beside the second.
fn load_triangle(index: u32) -> Corners {
    let a = bitcast<vec4<f32>>(triangle_quad(index * 3u));
    let b = bitcast<vec4<f32>>(triangle_quad(index * 3u + 1u));
    let c = bitcast<vec4<f32>>(triangle_quad(index * 3u + 2u));
    return Corners(v(a.xyz), v(b.xyz), v(c.xyz), n(b.w));
}
