use rayon::prelude::*;
use rayproof_scene::random::Random;
use rayproof_scene::{Hit, Ray, Scene};

use super::Primary;
use super::bounce::bounce;
use crate::batch::{BATCH, share};
use crate::{DeviceChoice, Error, Intersector, Options};

/// Rays that leave the surface where primary rays hit it, in cosine-weighted random directions about the geometric normal: what a
/// path tracer asks next.
///
/// Each hit of the picture sends out its even share of the rays. The picture is traced twice on the CPU, to count the hits and to
/// send the rays, so that it need not be kept.
pub struct Diffuse<'a> {
    scene: &'a Scene,
    primary: Primary<'a>,
    engine: Intersector,
    hits: u64,
}

/// How `rays` are dealt out over `hits`: hit `k` sends those from `k rays / hits` to `(k + 1) rays / hits`.
#[derive(Clone, Copy)]
struct Shares {
    hits: u64,
    rays: u64,
}

impl Shares {
    /// The first ray of hit `k`.
    fn first(self, k: u64) -> u64 {
        share(k, self.hits, self.rays)
    }

    /// The hit that sends ray `i`: the last `k` with `first(k) <= i`.
    fn hit(self, i: u64) -> u64 {
        let exact = ((u128::from(i) + 1) * u128::from(self.hits)).div_ceil(u128::from(self.rays)) - 1;
        u64::try_from(exact).unwrap_or(u64::MAX)
    }
}

impl<'a> Diffuse<'a> {
    /// Traces a picture of the scene; `progress` hears how many more of its rays are traced.
    ///
    /// # Errors
    /// As [`Intersector::new`].
    pub fn new(scene: &'a Scene, primary: Primary<'a>, mut progress: impl FnMut(usize)) -> Result<Self, Error> {
        let options = Options { device: DeviceChoice::Cpu, ..Options::default() };
        let mut seen = Self { scene, primary, engine: Intersector::new(scene, &options)?, hits: 0 };
        let mut hits = 0;
        seen.trace(|traced, pairs| {
            progress(traced);
            hits += pairs.len() as u64;
            Ok::<(), Error>(())
        })?;
        seen.hits = hits;
        Ok(seen)
    }

    /// How many primary rays hit. Where none does there are no diffuse rays.
    #[must_use]
    pub const fn hits(&self) -> u64 {
        self.hits
    }

    /// Makes `count` rays, and hands them on in blocks, by the order of the hits that they leave from. A block may be empty, where
    /// many primary rays in a row miss: `sink` can end the work at any time.
    ///
    /// # Errors
    /// What `sink` returns.
    pub fn send<E: From<Error>>(
        &self,
        count: u64,
        seed: u64,
        mut sink: impl FnMut(&[Ray]) -> Result<(), E>,
    ) -> Result<(), E> {
        let shares = Shares { hits: self.hits, rays: count };
        let mut first_hit = 0;
        let mut rays = Vec::new();
        self.trace(|_, pairs| {
            if pairs.is_empty() {
                return sink(&[]);
            }
            let next_hit = first_hit + pairs.len() as u64;
            let (first, last) = (shares.first(first_hit), shares.first(next_hit));
            for from in (first..last).step_by(BATCH) {
                let to = last.min(from.saturating_add(BATCH as u64));
                rays.clear();
                rays.par_extend((from..to).into_par_iter().map(|i| {
                    #[expect(clippy::cast_possible_truncation, reason = "less than the length of a slice")]
                    let (ray, hit) = &pairs[(shares.hit(i) - first_hit) as usize];
                    bounce(self.scene, ray, hit, &mut Random::new(seed, i))
                }));
                sink(&rays)?;
            }
            first_hit = next_hit;
            Ok(())
        })
    }

    /// Calls `f` for each block of the picture: how many rays it has, and those that hit, and where.
    fn trace<E: From<Error>>(&self, mut f: impl FnMut(usize, &[(Ray, Hit)]) -> Result<(), E>) -> Result<(), E> {
        let mut hits = Vec::new();
        for rays in self.primary.blocks(BATCH) {
            hits.clear();
            hits.resize(rays.len(), Hit::MISS);
            self.engine.closest(&rays, &mut hits)?;
            let traced = rays.len();
            let pairs: Vec<(Ray, Hit)> =
                rays.into_iter().zip(hits.iter().copied()).filter(|(_, h)| h.is_hit()).collect();
            f(traced, &pairs)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    fn every_ray_has_one_hit_and_every_hit_its_even_share() {
        for (hits, rays) in [(1, 1), (1, 10), (3, 10), (10, 3), (7, 7), (1000, 999), (13, 100_000)] {
            let shares = Shares { hits, rays };
            let mut counts = vec![0_u64; hits as usize];
            for i in 0..rays {
                let k = shares.hit(i);
                assert!(shares.first(k) <= i && i < shares.first(k + 1), "ray {i} of {rays}, hit {k} of {hits}");
                counts[k as usize] += 1;
            }
            assert!(counts.iter().all(|count| count.abs_diff(rays / hits) <= 1), "{counts:?}");
        }
    }
}
