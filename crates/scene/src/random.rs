//! Random numbers that depend on the seed and on the number of the ray alone, so that a file is the same on every
//! machine, in every version, and however its making is cut into pieces.

use glam::DVec3;

/// `SplitMix64` (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
#[derive(Clone, Copy, Debug)]
pub struct Random(u64);

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Random {
    /// The stream of ray `index`, or of whatever else a number names.
    #[must_use]
    pub const fn new(seed: u64, index: u64) -> Self {
        // Mixed twice: streams start at unrelated points of the one cycle.
        Self(mix(mix(seed.wrapping_add(GOLDEN)).wrapping_add(index)))
    }

    /// The stream that starts right after this state of `SplitMix64`.
    #[must_use]
    pub const fn from_state(state: u64) -> Self {
        Self(state)
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        mix(self.0)
    }

    /// A whole number below `n`; for a small `n`, each about as likely.
    ///
    /// # Panics
    /// When `n` is 0.
    pub const fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// A number from 0 to 1, 1 excluded, in steps of 2^-53.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub const fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from 0 to 1, 1 excluded, in steps of 2^-24.
    #[expect(clippy::cast_precision_loss, reason = "24 bits fit")]
    pub const fn single(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u32 << 24) as f32
    }

    /// A point of the unit cube.
    pub const fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// A point of the unit sphere's surface, uniformly (Marsaglia 1972). Only square roots: the same on every machine.
    pub fn on_sphere(&mut self) -> DVec3 {
        loop {
            let (x, y) = (2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0);
            let s = x * x + y * y;
            if s < 1.0 {
                let r = 2.0 * (1.0 - s).sqrt();
                return DVec3::new(x * r, y * r, 1.0 - 2.0 * s);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bits_never_change() {
        // Published: SplitMix64 from state 0 gives e220a8397b1dcdaf, 6e789e6aa1b965f4, 06c45d188009454f.
        let mut random = Random(0);
        assert_eq!(
            [random.bits(), random.bits(), random.bits()],
            [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f]
        );
    }

    #[test]
    fn the_sphere_is_covered_evenly() {
        let n = 20_000_u32;
        let points: Vec<DVec3> = (0..n).map(|i| Random::new(7, u64::from(i)).on_sphere()).collect();
        assert!(points.iter().all(|p| (p.length() - 1.0).abs() < 1e-12));
        // Each coordinate is uniform on -1..1: mean 0 and second moment 1/3, with standard errors 0.58 / sqrt(n) and
        // 0.30 / sqrt(n). Five of them.
        let n = f64::from(n);
        let mean = points.iter().sum::<DVec3>() / n;
        let second = points.iter().map(|p| *p * *p).sum::<DVec3>() / n;
        assert!(mean.abs().max_element() < 5.0 * 0.58 / n.sqrt(), "{mean}");
        assert!((second - 1.0 / 3.0).abs().max_element() < 5.0 * 0.30 / n.sqrt(), "{second}");
    }
}
