//! The seeded draws that every family is made of: the same seed gives the same bits.

use glam::{DVec3, Vec3};
use rayproof_scene::random::Random;

use super::aim::round;

/// A stream of draws.
#[derive(Clone, Debug)]
pub struct Draw {
    random: Random,
}

impl Draw {
    /// The stream of one scene of one family, or of anything else that two numbers name.
    #[must_use]
    pub fn new(seed: u64, family: u32, scene: u64) -> Self {
        let mut random = Random::from_state(seed);
        for part in [u64::from(family), scene] {
            random = Random::from_state(random.bits() ^ part);
        }
        Self { random }
    }

    /// Uniform in `low..high`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.unit()
    }

    /// Log-uniform in `low..high`, both positive.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        self.range(low.ln(), high.ln()).exp()
    }

    /// Log-uniform within `decades` powers of ten of a nominal value, on both sides.
    pub(super) fn around(&mut self, nominal: f64, decades: f64) -> f64 {
        nominal * 10_f64.powf(self.range(-decades, decades))
    }

    /// A whole number in `low..=high`.
    pub(super) fn whole(&mut self, low: i32, high: i32) -> f64 {
        self.range(f64::from(low), f64::from(high) + 1.0).floor()
    }

    /// Three whole numbers in `low..=high`.
    pub(super) fn wholes(&mut self, low: i32, high: i32) -> DVec3 {
        DVec3::new(self.whole(low, high), self.whole(low, high), self.whole(low, high))
    }

    /// A power of two with an exponent in `low..=high`.
    pub(super) fn power(&mut self, low: i32, high: i32) -> f64 {
        self.whole(low, high).exp2()
    }

    /// An index below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.random.below(n as u64)).expect("below a usize")
    }

    /// One of these.
    pub(super) fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.range(0.0, 1.0) < probability
    }

    /// 1 or -1.
    pub(super) fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    /// A unit vector, uniform on the sphere.
    pub fn unit(&mut self) -> DVec3 {
        let z = self.range(-1.0, 1.0);
        let (sin, cos) = self.range(0.0, std::f64::consts::TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    }

    /// A unit vector at right angles to a unit vector.
    pub fn across(&mut self, to: DVec3) -> DVec3 {
        let (x, y) = to.any_orthonormal_pair();
        let (sin, cos) = self.range(0.0, std::f64::consts::TAU).sin_cos();
        x * cos + y * sin
    }

    /// The length of a direction: 1 for half of them, else anything from 1e-3 to 1e3.
    pub(super) fn length(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { self.log(1e-3, 1e3) }
    }

    /// One of the 48 ways to permute and mirror the axes.
    pub(super) fn turn(&mut self) -> Turn {
        let axes = self.pick(&[[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]]);
        Turn { axes, signs: [self.sign(), self.sign(), self.sign()].map(round) }
    }

    /// Four whole numbers, not all zero, that make a [`Frame`].
    pub(super) fn quaternion(&mut self) -> [f64; 4] {
        loop {
            let q = [0; 4].map(|_| self.whole(0, 4));
            if q != [0.0; 4] {
                return q;
            }
        }
    }

    /// A frame from a quaternion, its parts shuffled, its signs drawn: all these frames share one norm.
    pub(super) fn frame(&mut self, mut quaternion: [f64; 4]) -> Frame {
        for i in (1..4).rev() {
            quaternion.swap(i, self.below(i + 1));
        }
        Frame::new(quaternion.map(|part| part * self.sign()))
    }
}

/// One of these values, which may themselves be drawn.
pub(super) fn one_of<T: Copy, const N: usize>(values: [T; N], draw: &mut Draw) -> T {
    draw.pick(&values)
}

/// A permutation of the axes with mirrors: it moves points without rounding.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    axes: [usize; 3],
    signs: [f32; 3],
}

impl Turn {
    /// Moves a point or a direction.
    pub(super) fn apply(self, p: Vec3) -> Vec3 {
        let p = p.to_array();
        Vec3::from_array([0, 1, 2].map(|i| p[self.axes[i]] * self.signs[i]))
    }
}

/// Three vectors of whole numbers at right angles, all exactly `norm` long: slanted geometry without rounding.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) x: DVec3,
    pub(super) y: DVec3,
    pub(super) z: DVec3,
    /// The length of each, at most 64 for a drawn one.
    pub(super) norm: f64,
}

impl Frame {
    /// The columns of the rotation matrix of a whole quaternion, times its squared length (Euler and Rodrigues).
    fn new([a, b, c, d]: [f64; 4]) -> Self {
        Self {
            x: DVec3::new(a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)),
            y: DVec3::new(2.0 * (b * c - a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d + a * b)),
            z: DVec3::new(2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a - b * b - c * c + d * d),
            norm: a * a + b * b + c * c + d * d,
        }
    }
}
