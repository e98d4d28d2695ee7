//! The device's `f32` arithmetic, measured.

mod print;

use bytemuck::{Pod, Zeroable};

use crate::Error;
use crate::context::Context;
use crate::link::Linked;
use crate::route::Route;

/// 2^-64: it makes small numbers subnormal.
const SMALL: f32 = f32::from_bits((127 - 64) << 23);

/// Pairs of numbers tried.
const PAIRS: usize = 1 << 14;

/// How often each operation differed from IEEE 754's answer, of [`pairs`](Self::pairs) pairs of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint {
    /// The route measured.
    pub route: Route,
    /// How many pairs were tried.
    pub pairs: usize,
    /// Sums that are not the nearest number.
    pub sum_wrong: usize,
    /// Products that are not the nearest number.
    pub product_wrong: usize,
    /// Sums' errors (TwoSum) that did not survive the compiler.
    pub sum_error_wrong: usize,
    /// Products' errors (TwoProduct by halves) that did not survive.
    pub product_error_wrong: usize,
    /// Differences of two products that are not what three roundings give.
    pub contracted: usize,
    /// Quotients that are not the nearest number, and the largest distance in ULP.
    pub quotient_wrong: usize,
    /// The largest distance of a quotient, in ULP of numbers.
    pub quotient_ulp: u32,
    /// Square roots that are not the nearest number.
    pub root_wrong: usize,
    /// The largest distance of a square root, in ULP of numbers.
    pub root_ulp: u32,
    /// `fma` results that are fused.
    pub fused: usize,
    /// Comparisons, NaN and subnormals among them, that IEEE answers otherwise.
    pub comparisons_wrong: usize,
    /// Subnormal results that were flushed or are wrong, of [`subnormals`](Self::subnormals).
    pub subnormals_wrong: usize,
    /// How many subnormal results were asked for.
    pub subnormals: usize,
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Results {
    sum: f32,
    sum_error: f32,
    product: f32,
    product_error: f32,
    contracted: f32,
    quotient: f32,
    root: f32,
    fma_error: f32,
    comparisons: u32,
    scaled: f32,
}

impl Fingerprint {
    /// Runs the check kernel on a device.
    pub(crate) fn measure(context: &Context, route: Route) -> Result<Self, Error> {
        let pairs = pairs();
        Ok(Self::judge(route, &pairs, &run(context, route, &pairs)?))
    }

    /// Whether kernels on this route give the CPU's bits: every operation they use is IEEE's, unfused, and survives.
    #[must_use]
    pub const fn is_ieee(&self) -> bool {
        self.sum_wrong == 0
            && self.product_wrong == 0
            && self.contracted == 0
            && self.quotient_wrong == 0
            && self.root_wrong == 0
            && self.comparisons_wrong == 0
            && self.subnormals_wrong == 0
    }

    /// Whether sums, products and quotients are to the nearest, but for subnormals, and square roots within 1 ULP: what the bounds
    /// of `exact` suppose of `f32` that is IEEE.
    #[must_use]
    pub const fn rounds_to_nearest(&self) -> bool {
        self.sum_wrong == 0
            && self.product_wrong == 0
            && self.contracted == 0
            && self.quotient_wrong == 0
            && self.root_ulp <= 1
    }

    /// Whether no subnormal number is taken for 0, as an operand, a result, or where it is compared.
    #[must_use]
    pub const fn keeps_subnormals(&self) -> bool {
        self.subnormals_wrong == 0 && self.comparisons_wrong == 0
    }

    /// Whether error-free transforms survive.
    #[must_use]
    pub const fn keeps_errors(&self) -> bool {
        self.sum_error_wrong == 0 && self.product_error_wrong == 0
    }

    fn judge(route: Route, pairs: &[[f32; 2]], results: &[Results]) -> Self {
        let mut f = Self {
            route,
            pairs: pairs.len(),
            sum_wrong: 0,
            product_wrong: 0,
            sum_error_wrong: 0,
            product_error_wrong: 0,
            contracted: 0,
            quotient_wrong: 0,
            quotient_ulp: 0,
            root_wrong: 0,
            root_ulp: 0,
            fused: 0,
            comparisons_wrong: 0,
            subnormals_wrong: 0,
            subnormals: 0,
        };
        for (&[x, y], r) in pairs.iter().zip(results) {
            f.comparisons_wrong += usize::from(r.comparisons != comparisons(x, y));
            if x.is_nan() || y.is_nan() {
                continue;
            }
            f.see_subnormal(x * SMALL, r.scaled);
            f.see_subnormal(x * y, r.product);
            if !ordinary(x) || !ordinary(y) {
                continue;
            }
            f.sum_wrong += usize::from(differ(x + y, r.sum));
            f.sum_error_wrong += usize::from(differ(sum_error(x, y), r.sum_error));
            f.product_wrong += usize::from(differ(x * y, r.product));
            f.product_error_wrong += usize::from(differ(product_error(x, y), r.product_error));
            f.contracted += usize::from(differ(x * y - (y * x) * 1.000_000_1, r.contracted));
            f.quotient_wrong += usize::from(differ(x / y, r.quotient));
            f.quotient_ulp = f.quotient_ulp.max((x / y).to_bits().abs_diff(r.quotient.to_bits()));
            f.root_wrong += usize::from(differ(x.abs().sqrt(), r.root));
            f.root_ulp = f.root_ulp.max(x.abs().sqrt().to_bits().abs_diff(r.root.to_bits()));
            f.fused += usize::from(r.fma_error != 0.0);
        }
        f
    }

    fn see_subnormal(&mut self, right: f32, measured: f32) {
        if right.is_subnormal() {
            self.subnormals += 1;
            self.subnormals_wrong += usize::from(differ(right, measured));
        }
    }
}

fn differ(right: f32, measured: f32) -> bool {
    right.to_bits() != measured.to_bits() && !(right == 0.0 && measured == 0.0)
}

fn comparisons(x: f32, y: f32) -> u32 {
    let at_least = x >= y;
    u32::from(x < y) | (u32::from(at_least) << 1) | (u32::from(!at_least) << 2)
}

/// What `x + y` lost: exact in `f64` and an `f32` itself.
#[expect(clippy::cast_possible_truncation, reason = "the error of a sum is an f32")]
fn sum_error(x: f32, y: f32) -> f32 {
    (f64::from(x) + f64::from(y) - f64::from(x + y)) as f32
}

/// What `x y` lost.
#[expect(clippy::cast_possible_truncation, reason = "the error of a product is an f32")]
fn product_error(x: f32, y: f32) -> f32 {
    (f64::from(x) * f64::from(y) - f64::from(x * y)) as f32
}

/// Whether sums, products and their errors stay clear of overflow and of subnormals: those are measured apart.
fn ordinary(x: f32) -> bool {
    (1e-9..1e9).contains(&x.abs())
}

/// Pairs with magnitudes from 2^-12 to 2^12, so that sums lose bits and `f64` holds them all; then small ones, subnormals beside
/// zero and beside each other, and NaN.
fn pairs() -> Vec<[f32; 2]> {
    // A generator of its own: devices have been measured with these very pairs, and a test holds what one of them gave.
    let mut state = 0x005e_ed00_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 33
    };
    let mut number = |low: u64, span: u64| {
        let (bits, exponent, sign) = (next() & 0x7f_ffff, low + next() % span, next() & 1);
        f32::from_bits(u32::try_from((sign << 31) | (exponent << 23) | bits).expect("32 bits"))
    };
    let mut pairs: Vec<[f32; 2]> = (0..PAIRS - 512).map(|_| [number(127 - 12, 25), number(127 - 12, 25)]).collect();
    pairs.extend((0..256).map(|_| [number(127 - 80, 18), number(127 - 70, 8)]));
    pairs.extend((0..176).map(|_| [number(0, 1), number(127, 1)]));
    pairs.extend((0..16).flat_map(|_| {
        let [x, y] = [number(0, 1), number(0, 1)];
        [[x, 0.0], [0.0, x], [x, -x], [x, y]]
    }));
    pairs.extend([[f32::NAN, 1.0], [1.0, f32::NAN], [f32::NAN, f32::NAN], [0.0, -0.0]].repeat(4));
    pairs
}

fn run(context: &Context, route: Route, pairs: &[[f32; 2]]) -> Result<Vec<Results>, Error> {
    let mut linked = Linked::default();
    linked.add("fingerprint.wgsl", rayproof_shaders::source("fingerprint.wgsl"));
    let kernel = context.compile_alone(&linked, ["fingerprint"; 2], route)?;
    let count = u32::try_from(pairs.len()).expect("PAIRS");
    context.run_once(&kernel, [count, 0], bytemuck::cast_slice(pairs), pairs.len(), count)
}

#[cfg(test)]
mod tests;
