// A number of a hit, rounded to the nearest f32.
//
// A value known as q within `off` rounds to r, whatever the mode that made r from q, when r - q + off and q - r + off are less than
// half the gaps between r and its neighbours; below a power of two that is half of what it is above. Numbers below 2^-60 or above
// 2^100, in scaled units, are left to the CPU.
struct Values { settled: bool, t: f32, u: f32, v: f32 }

// Whether what lies within `outward` of r, away from 0, and within `inward`, towards 0, rounds to it; both may be short by 2^-23 of
// themselves.
fn settles(r: f32, outward: f32, inward: f32) -> bool {
    let bits = bitcast<u32>(r) & 0x7fffffffu;
    let power = bits & 0x7f800000u;
    let half = bitcast<f32>(power - 24u * 0x00800000u) * 0.9999997615814209; // 1 - 2^-22
    return abs(r) >= 8.673617379884035e-19 // 2^-60
        && abs(r) <= 1.2676506002282294e30 // 2^100
        && outward < half
        && inward < select(half, 0.5 * half, bits == power);
}

fn rounds_to(r: f32, q: N, off: N) -> bool {
    let rest = sub(q, n(r));
    let outward = pick(rest, sub(n(0.0), rest), r < 0.0);
    return settles(r, above(add(off, outward)), above(sub(off, outward)));
}
