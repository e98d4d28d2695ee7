//! The device's `f32` arithmetic, measured.

mod print;

use std::fmt;

use bytemuck::{Pod, Zeroable};

use crate::Error;
use crate::context::Context;
use crate::link::Linked;
use crate::route::Route;

/// 2^-64: it makes small numbers subnormal.
const SMALL: f32 = f32::from_bits((127 - 64) << 23);

/// 2^100: it makes subnormals ordinary.
const LARGE: f32 = f32::from_bits((127 + 100) << 23);

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
    /// Comparisons of ordinary numbers and of NaN that IEEE answers otherwise.
    pub comparisons_wrong: usize,
    /// Products with 1, sums with 0, conversions, sizes, minima, maxima, choices and vectors of ordinary numbers that are not what
    /// is written.
    pub folded: usize,
    /// Subnormal results that were flushed or are wrong, of [`subnormals`](Self::subnormals).
    pub subnormals_wrong: usize,
    /// How many subnormal results were asked for.
    pub subnormals: usize,
    /// Subnormal operands that were taken for 0 in a product, of [`subnormal_operands`](Self::subnormal_operands).
    pub subnormal_operands_wrong: usize,
    /// How many subnormal operands there were.
    pub subnormal_operands: usize,
    /// Comparisons with a subnormal that IEEE answers otherwise.
    pub subnormal_comparisons_wrong: usize,
    /// Subnormals that did not pass through a choice or a conversion of their bits: integer arithmetic on them stands on that.
    pub subnormal_bits_wrong: usize,
}

/// What a device's `f32` arithmetic is, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// All that kernels use is IEEE's: `fast` has the CPU's bits.
    Ieee,
    /// IEEE's for all but subnormal numbers, which are taken for 0: `fast` has the CPU's bits where no number of the ray, of the
    /// scene and in between is subnormal.
    IeeeButForSubnormals,
    /// `fast` has other bits, within its promise where the scene has no extremes.
    NotIeee,
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ieee => "IEEE",
            Self::IeeeButForSubnormals => "IEEE but for subnormals",
            Self::NotIeee => "not IEEE",
        })
    }
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
    lifted: f32,
    moved: f32,
    times_one: f32,
    plus_zero: f32,
    whole: f32,
    fraction: f32,
    absolute: f32,
    least: f32,
    most: f32,
    selected: f32,
    packed: f32,
}

impl Fingerprint {
    /// Runs the check kernel on a device.
    pub(crate) fn measure(context: &Context, route: Route) -> Result<Self, Error> {
        let pairs = pairs();
        Ok(Self::judge(route, &pairs, &run(context, route, &pairs)?))
    }

    /// What the arithmetic is, in a word.
    #[must_use]
    pub const fn arithmetic(&self) -> Arithmetic {
        let is_right =
            self.rounds_to_nearest() && self.root_wrong == 0 && self.comparisons_wrong == 0 && self.folded == 0;
        match (is_right, self.keeps_subnormals()) {
            (true, true) => Arithmetic::Ieee,
            (true, false) => Arithmetic::IeeeButForSubnormals,
            (false, _) => Arithmetic::NotIeee,
        }
    }

    /// Whether kernels on this route give the CPU's bits: every operation they use is IEEE's, unfused, and survives.
    #[must_use]
    pub const fn is_ieee(&self) -> bool {
        matches!(self.arithmetic(), Arithmetic::Ieee)
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
        self.subnormals_wrong == 0
            && self.subnormal_operands_wrong == 0
            && self.subnormal_comparisons_wrong == 0
            && self.subnormal_bits_wrong == 0
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
            folded: 0,
            subnormals_wrong: 0,
            subnormals: 0,
            subnormal_operands_wrong: 0,
            subnormal_operands: 0,
            subnormal_comparisons_wrong: 0,
            subnormal_bits_wrong: 0,
        };
        for (&[x, y], r) in pairs.iter().zip(results) {
            let compared = usize::from(r.comparisons != comparisons(x, y));
            if x.is_subnormal() || y.is_subnormal() {
                f.subnormal_comparisons_wrong += compared;
            } else {
                f.comparisons_wrong += compared;
            }
            if x.is_nan() || y.is_nan() {
                continue;
            }
            f.see_subnormal(x * SMALL, r.scaled);
            f.see_subnormal(x * y, r.product);
            f.see_operand(x, r);
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
            f.folded += usize::from(folds(x, y, r));
        }
        f
    }

    fn see_operand(&mut self, x: f32, r: &Results) {
        #[expect(clippy::cast_precision_loss, reason = "23 bits")]
        let fraction = (x.to_bits() & 0x007f_ffff) as f32;
        let is_moved = r.moved.to_bits() == x.to_bits() && r.fraction == fraction;
        self.subnormal_bits_wrong += usize::from(!is_moved);
        if x.is_subnormal() {
            self.subnormal_operands += 1;
            self.subnormal_operands_wrong += usize::from(differ(x * LARGE, r.lifted));
        }
    }

    fn see_subnormal(&mut self, right: f32, measured: f32) {
        if right.is_subnormal() {
            self.subnormals += 1;
            self.subnormals_wrong += usize::from(differ(right, measured));
        }
    }
}

/// Whether any of what a compiler may fold is not what is written.
fn folds(x: f32, y: f32, r: &Results) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "the fraction goes")]
    let whole = (x * 4096.0) as i32;
    #[expect(clippy::cast_precision_loss, reason = "24 bits")]
    let expected = [
        (x, r.times_one),
        (x + 0.0, r.plus_zero),
        (whole as f32, r.whole),
        (x.abs(), r.absolute),
        (x.min(y), r.least),
        (x.max(y), r.most),
        (if x < y { y } else { x }, r.selected),
        (x * y + y, r.packed),
    ];
    expected.into_iter().any(|(right, measured)| differ(right, measured))
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
