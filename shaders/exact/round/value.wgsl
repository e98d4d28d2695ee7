// A number of a hit, rounded to the nearest f32.
//
// A value known as q within `off` rounds to r, whatever the mode that made r from q, when |q - r| + off is less than half the
// gap between r and its nearer neighbour. Numbers below 2^-60 or above 2^100, in scaled units, are left to the CPU.
struct Values { settled: bool, t: f32, u: f32, v: f32 }

fn half_gap(r: f32) -> f32 {
    let bits = bitcast<u32>(r) & 0x7fffffffu;
    let power = bits & 0x7f800000u;
    // Below a power of two the gap is half as wide.
    return bitcast<f32>(power - select(24u, 25u, bits == power) * 0x00800000u);
}

// Whether what lies within `away` of r rounds to it.
fn settles(r: f32, away: f32) -> bool {
    return abs(r) >= 8.673617379884035e-19 // 2^-60
        && abs(r) <= 1.2676506002282294e30 // 2^100
        && away < half_gap(r);
}

fn rounds_to(r: f32, q: N, off: N) -> bool {
    return settles(r, above(add(size(sub(q, n(r))), off)));
}
