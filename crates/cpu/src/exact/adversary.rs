//! An `f32` arithmetic that errs wherever WGSL and Vulkan let it: products fused into sums or not, rounding to either
//! neighbour, quotients 2.5 ULP off, square roots by `1 / inverseSqrt`, subnormals flushed, as operands and as results.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use rayproof_scene::random::Random;

use crate::twin::exact::number::Number;
use crate::twin::exact::number::pair::Part;

/// Which way results are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rounding {
    Nearest,
    Up,
    Down,
    /// To either neighbour, by lot.
    Either,
}

/// Whether `a b + c` is rounded once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fusing {
    Never,
    Always,
    ByLot,
}

/// One arithmetic.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arithmetic {
    pub(super) rounding: Rounding,
    pub(super) fusing: Fusing,
    /// Quotients are up to 2.5 ULP off, and square roots by `1 / inverseSqrt`; else both are correctly rounded.
    pub(super) loose: bool,
    pub(super) flushing: bool,
}

impl Arithmetic {
    /// Every combination.
    pub(super) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for rounding in [Rounding::Nearest, Rounding::Up, Rounding::Down, Rounding::Either] {
            for fusing in [Fusing::Never, Fusing::Always, Fusing::ByLot] {
                for [loose, flushing] in [[false, false], [false, true], [true, false], [true, true]] {
                    all.push(Self { rounding, fusing, loose, flushing });
                }
            }
        }
        all
    }
}

thread_local! {
    static ARITHMETIC: Cell<Arithmetic> = const {
        Cell::new(Arithmetic { rounding: Rounding::Nearest, fusing: Fusing::Never, loose: false, flushing: false })
    };
    static LOT: Cell<Random> = const { Cell::new(Random::new(1, 0)) };
}

/// Makes this thread compute by an arithmetic.
pub(super) fn compute_by(arithmetic: Arithmetic) {
    ARITHMETIC.set(arithmetic);
}

fn lot() -> u64 {
    let mut random = LOT.get();
    let lot = random.bits();
    LOT.set(random);
    lot
}

/// A number of that arithmetic, and where it is a product the exact one, for a sum to fuse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Adverse {
    pub(super) value: f32,
    product: Option<f64>,
}

impl Adverse {
    pub(super) fn new(value: f32) -> Self {
        Self { value, product: None }
    }

    /// As an operand.
    fn read(self) -> f32 {
        flushed(self.value)
    }

    /// The exact product, where a sum may and does take it.
    fn fused(self) -> Option<f64> {
        let product = self.product?;
        match ARITHMETIC.get().fusing {
            Fusing::Never => None,
            Fusing::Always => Some(product),
            Fusing::ByLot => (lot().is_multiple_of(2)).then_some(product),
        }
    }
}

/// The exact `high + low` rounded.
#[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
fn rounded(high: f64, low: f64) -> f32 {
    let near = high as f32;
    // How the exact number compares with the nearest: the difference of the leading parts is exact or decides.
    let rest = (high - f64::from(near)) + low;
    let (down, up) = if rest > 0.0 {
        (near, near.next_up())
    } else if rest < 0.0 {
        (near.next_down(), near)
    } else {
        (near, near)
    };
    flushed(match ARITHMETIC.get().rounding {
        Rounding::Nearest => near,
        Rounding::Up => up,
        Rounding::Down => down,
        Rounding::Either => {
            if lot().is_multiple_of(2) {
                up
            } else {
                down
            }
        }
    })
}

fn flushed(x: f32) -> f32 {
    if ARITHMETIC.get().flushing && x.is_subnormal() { 0.0 } else { x }
}

/// A number moved by some ULP, at most so many.
fn moved(mut x: f32, most: u64) -> f32 {
    let steps = lot() % (most + 1);
    let up = lot().is_multiple_of(2);
    for _ in 0..steps {
        x = if up { x.next_up() } else { x.next_down() };
    }
    x
}

fn sum(a: Adverse, b: Adverse) -> Adverse {
    // A fused operation takes one product.
    let (x, y) = match (a.fused(), b.fused()) {
        (Some(x), None) => (x, f64::from(b.read())),
        (None, Some(y)) => (f64::from(a.read()), y),
        (Some(x), Some(y)) => {
            if lot().is_multiple_of(2) {
                (x, f64::from(b.read()))
            } else {
                (f64::from(a.read()), y)
            }
        }
        (None, None) => (f64::from(a.read()), f64::from(b.read())),
    };
    let high = x + y;
    let part = high - x;
    Adverse::new(rounded(high, (x - (high - part)) + (y - part)))
}

impl Add for Adverse {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        sum(self, other)
    }
}

impl Sub for Adverse {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        sum(self, Self { value: -other.value, product: other.product.map(|p| -p) })
    }
}

impl Mul for Adverse {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = f64::from(self.read()) * f64::from(other.read());
        Self { value: rounded(product, 0.0), product: Some(product) }
    }
}

impl Div for Adverse {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let quotient = self.read() / other.read();
        // The nearest is half an ULP off at most.
        Self::new(flushed(if ARITHMETIC.get().loose { moved(quotient, 2) } else { quotient }))
    }
}

impl Neg for Adverse {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.read(), product: self.product.map(|p| -p) }
    }
}

impl Part for Adverse {
    const SPLITTER: Self = Self { value: 4097.0, product: None };
}

impl Number for Adverse {
    type Mask = bool;

    fn constant(x: f32) -> Self {
        Self::new(x)
    }
    fn abs(self) -> Self {
        Self { value: self.read().abs(), product: self.product.map(f64::abs) }
    }
    fn min(self, other: Self) -> Self {
        Self::new(if other.less(self) { other.read() } else { self.read() })
    }
    fn max(self, other: Self) -> Self {
        Self::new(if self.less(other) { other.read() } else { self.read() })
    }
    #[expect(clippy::cast_possible_truncation, reason = "this is the rounding")]
    fn sqrt(self) -> Self {
        let x = self.read();
        if !ARITHMETIC.get().loose || x == 0.0 {
            return Self::new(x.sqrt());
        }
        let inverse = moved((1.0 / f64::from(x).sqrt()) as f32, 1);
        Self::new(moved(1.0 / inverse, 2))
    }
    fn less(self, other: Self) -> bool {
        self.read() < other.read()
    }
    fn equal(self, other: Self) -> bool {
        self.read() == other.read()
    }
    fn pick(no: Self, yes: Self, mask: bool) -> Self {
        if mask { yes } else { no }
    }
}

mod tests;
