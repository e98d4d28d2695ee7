// Vectors of numbers that are sums of two or three f32, by error-free transforms (number/pair.wgsl has them for one number).
struct Two { high: vec3<f32>, low: vec3<f32> }
struct Three { high: vec3<f32>, middle: vec3<f32>, low: vec3<f32> }

// a + b and what rounding lost.
fn two_sums(a: vec3<f32>, b: vec3<f32>) -> Two {
    let high = a + b;
    let part = high - a;
    return Two(high, (a - (high - part)) + (b - part));
}

// A vector of sums of two, to be multiplied: with its upper words cut in halves.
struct Factor { high: vec3<f32>, low: vec3<f32>, upper: vec3<f32>, lower: vec3<f32> }

fn factor(x: Two) -> Factor {
    let scaled = SPLITTER * x.high;
    let upper = scaled - (scaled - x.high);
    return Factor(x.high, x.low, upper, x.high - upper);
}

// s times the upper words, and what rounding lost.
fn two_products(x: Factor, s: f32) -> Two {
    let high = x.high * s;
    let half = split(s);
    let low = ((x.upper * half.high - high) + x.upper * half.low + x.lower * half.high) + x.lower * half.low;
    return Two(high, low);
}

// The sum of three vectors anew, so that each is no more than a rounding of the one before, unless that is 0.
fn renewed(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Three {
    let first = two_sums(a, b);
    let second = two_sums(first.low, c);
    let high = two_sums(first.high, second.high);
    let middle = two_sums(high.low, second.low);
    return Three(high.high, middle.high, middle.low);
}
