// What is certain of a line and a sphere, by the foot of the perpendicular from the centre.
//
// With o = e - c, a = d.d, m = -(d.o)/a and l = o + m d: the roots are m -+ h, h^2 = (r^2 - l.l)/a. (The discriminant
// B^2 - 4AC of the quadratic is 4 a (r^2 - l.l), without its cancellation.)
//
// Bounds, to first order in u (see line.wgsl); far = |o| by its largest component, |.| below the Euclidean length:
// * o: u of each component. a: 3 u; 1/a: 5.5 u.
// * m: d.o has 4 u |d| |o|, 1/a 5.5 u, the product u: 10.5 u |o| / |d| <= 18.2 u far / |d|. Used: 28.
// * l: o u, m d 10.5 u + u, the sum u, each of |o|: 13.5 u |o| <= 23.4 u far. Used: 28 u far =: foot.
// * s = r^2 - l.l: where the true |l| <= r, l.l is off by (2 r + foot) foot and the roundings lose 5 u r^2 and parts of foot^2 u;
//   used: (2 r + foot) foot + 12 u r^2 =: off_s. Where the true |l| > r the computed s is at most off_s. So s < -off_s is a
//   miss, and s > 2 off_s a line that enters.
// * h = sqrt(s/a), where the line enters: |sqrt(x) - sqrt(y)| <= |x - y| / (1.7 sqrt(x)) for y >= x/2, so off_s / (1.7 a h),
//   and 7.75 u h for 1/a, the product and the root (8.75 where a root is 1 ULP off, which
//   only devices are that round quotients to the nearest). Used: 1.0625 off_s / (a h) and 12 u h.
// * The roots: the bounds of m and h, and u (|m| + |h|) for the sum. Used: 12 u |m| more.
struct Chord {
    misses: bool,
    enters: bool,
    // The roots are middle -+ half, each within off; where it is not certain that the line enters, whatever roots there are lie
    // within half + off of middle.
    middle: N,
    half: N,
    off: N,
}

fn chord(ray: Line, center: V, radius: N) -> Chord {
    let o = minus(ray.origin, center);
    let d = ray.direction;
    let middle = sub(n(0.0), mul(dot_n(d, o), ray.inverse_a));
    let l = V(add(o.x, mul(middle, d.x)), add(o.y, mul(middle, d.y)), add(o.z, mul(middle, d.z)));
    let rr = mul(radius, radius);
    let square = sub(rr, dot_n(l, l));
    let far = largest_n(o);
    let foot = mul(far, ray.foot_error);
    let off_square =
        add(add(mul(add(add(radius, radius), foot), foot), mul(rr, ray.root_error)), ray.tiny_sphere);
    let off_middle = add(mul(far, ray.middle_error), ray.tiny_sphere);
    let misses = less(add(square, off_square), n(0.0));
    let enters = less(add(off_square, off_square), square);
    // Where it is not certain that the line enters, the longest chord there may be.
    let longest = add(larger(square, n(0.0)), off_square);
    let half = root(mul(pick(longest, square, enters), ray.inverse_a));
    let off_half = pick(n(0.0), div(mul(off_square, ray.inverse_a), pick(n(1.0), half, enters)), enters);
    let rounding = add(mul(half, ray.root_error), mul(size(middle), ray.root_error));
    let off = add(add(off_middle, mul(off_half, n(1.0625))), rounding);
    return Chord(misses, enters, middle, half, off);
}
