// An f64 as a nearby f32.
//
// A compiler may fold f64(f32(x)) to x: NoContraction stands on arithmetic and not on conversions, and Mesa 25 does it, so that
// x - f64(f32(x)) is 0 there. So x is rounded to 24 bits by arithmetic first (Veltkamp's splitting): the conversion then changes
// nothing, and to fold it is harmless.
fn narrow(x: f64) -> f32 {
    let scaled = 536870913.0lf * x; // 2^29 + 1
    return f32(scaled - (scaled - x));
}
