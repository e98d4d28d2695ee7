//! Which rays a check looks at: so many of them, spread evenly over the batch, whether its length is known or not.

use rayproof_scene::Ray;

use crate::batch::share;

/// A ray and the answer that was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<A> {
    /// The number of the ray, counting from 0.
    pub index: u64,
    /// The ray.
    pub ray: Ray,
    /// The engine's answer.
    pub answer: A,
}

/// Picks samples out of the stream; holds at most twice as many as are wanted.
pub(super) struct Sampler<A> {
    want: u64,
    total: Option<u64>,
    /// Where the length is not known: every `stride`-th ray is kept.
    stride: u64,
    samples: Vec<Sample<A>>,
}

impl<A: Copy> Sampler<A> {
    /// Samples `want` of `total` rays, or all of them where there are fewer.
    pub(super) fn new(want: u64, total: Option<u64>) -> Self {
        Self { want: total.map_or(want, |total| want.min(total)), total, stride: 1, samples: Vec::new() }
    }

    /// Looks at the batch whose first ray has number `first`. Batches come in order.
    pub(super) fn take(&mut self, first: u64, rays: &[Ray], answers: &[A]) {
        let end = first + rays.len() as u64;
        let mut from = first;
        while let Some(index) = self.next(from).filter(|&index| index < end) {
            #[expect(clippy::cast_possible_truncation, reason = "less than the length of a slice")]
            let i = (index - first) as usize;
            self.samples.push(Sample { index, ray: rays[i], answer: answers[i] });
            if self.total.is_none() && self.samples.len() as u64 >= self.want.saturating_mul(2) {
                self.stride *= 2;
                self.samples.retain(|sample| sample.index % self.stride == 0);
            }
            from = index + 1;
        }
    }

    /// The next ray to look at, from number `from` on.
    fn next(&self, from: u64) -> Option<u64> {
        match self.total {
            _ if self.want == 0 => None,
            Some(total) => {
                let k = self.samples.len() as u64;
                (k < self.want).then(|| share(k, self.want, total))
            }
            None => Some(from.next_multiple_of(self.stride)),
        }
    }

    /// The samples, in the rays' order.
    pub(super) fn finish(self) -> Vec<Sample<A>> {
        let have = self.samples.len() as u64;
        if have <= self.want {
            return self.samples;
        }
        #[expect(clippy::cast_possible_truncation, reason = "less than the length of a vector")]
        (0..self.want).map(|k| self.samples[share(k, self.want, have) as usize]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    fn sample(want: u64, total: u64, known: bool, batch: u64) -> Vec<u64> {
        let mut sampler = Sampler::new(want, known.then_some(total));
        for first in (0..total).step_by(batch as usize) {
            let rays: Vec<Ray> = (first..total.min(first + batch))
                .map(|i| Ray::new(glam::Vec3::splat(i as f32), glam::Vec3::X))
                .collect();
            let answers: Vec<u64> = (first..total.min(first + batch)).collect();
            sampler.take(first, &rays, &answers);
            assert!(sampler.samples.len() as u64 <= want * 2, "memory");
        }
        let samples = sampler.finish();
        for sample in &samples {
            assert_eq!((sample.index, sample.index as f32), (sample.answer, sample.ray.origin.x));
        }
        samples.into_iter().map(|sample| sample.index).collect()
    }

    #[test]
    fn samples_are_as_many_as_asked_and_spread_evenly() {
        for known in [true, false] {
            for (want, total, batch) in
                [(0, 100, 7), (5, 0, 7), (5, 3, 2), (5, 5, 2), (7, 1000, 64), (100, 1000, 999), (999, 1000, 10)]
            {
                let indices = sample(want, total, known, batch);
                assert_eq!(indices.len() as u64, want.min(total), "{want} of {total}, known: {known}");
                // No gap wider than four times the even one, and the whole is covered.
                let gaps = indices.windows(2).map(|pair| pair[1] - pair[0]);
                let ends = indices.first().copied().into_iter().chain(indices.last().map(|last| total - last));
                for gap in gaps.clone().chain(ends) {
                    assert!(gap <= 4 * total.div_ceil(want.max(1)), "{indices:?}");
                }
                assert!(gaps.min().is_none_or(|gap| gap > 0), "no ray twice: {indices:?}");
            }
        }
        assert_eq!(sample(4, 8, true, 3), [0, 2, 4, 6]);
    }
}
