// Numbers of twice a width, as sums of two `Part`: f32 (number/pair_of_f32.wgsl) or f64 (number/pair_of_f64.wgsl).
//
// Sums and products are error-free transforms (Knuth's two-sum; Dekker's two-product, by splitting) followed by a
// renormalisation: relative errors of at most 3 v^2 and 7 v^2, v what the part's rounding loses (Joldes, Muller and Popescu
// 2017). A quotient and a root add correction steps: 16 v^2. The host runs this text only where the fingerprint showed that
// the transforms survive the driver. |low| is at most half an ULP of high.
struct N { high: Part, low: Part }

fn n(x: f32) -> N { return N(Part(x), Part(0.0)); }

fn two_sum(a: Part, b: Part) -> N {
    let high = a + b;
    let part = high - a;
    return N(high, (a - (high - part)) + (b - part));
}

// a + b and what rounding lost, where |a| >= |b| or a = 0.
fn quick_two_sum(a: Part, b: Part) -> N {
    let high = a + b;
    return N(high, b - (high - a));
}

// A number as a sum of two of half its bits.
fn split(a: Part) -> N {
    let scaled = SPLITTER * a;
    let high = scaled - (scaled - a);
    return N(high, a - high);
}

fn two_product(a: Part, b: Part) -> N {
    let high = a * b;
    let x = split(a);
    let y = split(b);
    return N(high, ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low);
}

fn add(a: N, b: N) -> N {
    let sum = two_sum(a.high, b.high);
    let rest = two_sum(a.low, b.low);
    let first = quick_two_sum(sum.high, sum.low + rest.high);
    return quick_two_sum(first.high, first.low + rest.low);
}

fn negated(a: N) -> N { return N(-a.high, -a.low); }
fn sub(a: N, b: N) -> N { return add(a, negated(b)); }

fn mul(a: N, b: N) -> N {
    let product = two_product(a.high, b.high);
    return quick_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

fn div(a: N, b: N) -> N {
    let first = N(a.high / b.high, Part(0.0));
    let rest = sub(a, mul(first, b));
    let second = N(rest.high / b.high, Part(0.0));
    let last = sub(rest, mul(second, b));
    return add(add(first, second), N(last.high / b.high, Part(0.0)));
}

fn root(a: N) -> N {
    if !(a.high > Part(0.0)) {
        return n(0.0);
    }
    let first = N(sqrt(a.high), Part(0.0));
    let second = sub(a, mul(first, first)).high / (Part(2.0) * first.high);
    let closer = add(first, N(second, Part(0.0)));
    return add(closer, N(sub(a, mul(closer, closer)).high / (Part(2.0) * first.high), Part(0.0)));
}

fn less(a: N, b: N) -> bool { return a.high < b.high || (a.high == b.high && a.low < b.low); }
fn pick(no: N, yes: N, which: bool) -> N { return N(select(no.high, yes.high, which), select(no.low, yes.low, which)); }
fn size(a: N) -> N { return pick(a, negated(a), a.high < Part(0.0)); }
fn smaller(a: N, b: N) -> N { return pick(a, b, less(b, a)); }
fn larger(a: N, b: N) -> N { return pick(a, b, less(a, b)); }

// What an answer is written as.
fn to_f32(x: N) -> f32 { return f32(x.high); }
// A nearby f32, within 2^-22.
fn about(x: N) -> f32 { return narrow(x.high); }
// At least x, and near it.
fn above(x: N) -> f32 { return about(x) + abs(about(x)) * 2.384185791015625e-7; } // 2^-22
