//! `rayproof rays --kind diffuse`: rays that leave the surface where primary rays hit it.
//!
//! Each hit of the picture sends out its even share of the rays. The picture is traced twice, to count the hits and to
//! send the rays, so that it need not be kept.

use rayon::prelude::*;
use rayproof::scene::{Camera, Hit, Ray, Scene};
use rayproof::{DeviceChoice, Intersector, Options};

use crate::args::Rays;
use crate::bounce::bounce;
use crate::exit::{Code, Failure};
use crate::interrupt;
use crate::parse::{Size, share};
use crate::pipeline::BATCH;
use crate::progress::Progress;
use crate::random::Random;
use crate::rays::{SIZE, Sink, row_blocks};
use crate::summary::grouped;

/// Writes the file.
pub(crate) fn diffuse(args: &Rays, scene: &Scene, camera: &Camera) -> Result<(), Failure> {
    let size = args.size.unwrap_or_else(|| args.count.map_or(SIZE, square));
    let options = Options { device: DeviceChoice::Cpu, ..Options::default() };
    let picture = Picture { scene, camera, engine: Intersector::new(scene, &options)?, size };
    let hits = picture.count(&Progress::new("looking", Some(size.pixels()), args.quiet))?;
    let total = args.count.unwrap_or(hits);
    if hits == 0 && total > 0 {
        let message = format!(
            "{}: none of {} primary rays hits the scene, so that no diffuse ray can leave it; \
             give a scene file with a [camera] that sees it",
            args.scene.display(),
            grouped(size.pixels())
        );
        return Err(Failure::new(Code::BadInput, message));
    }
    let mut sink = Sink::create(args, total)?;
    picture.send(Shares { hits, rays: total }, args.seed, &mut sink)?;
    sink.finish(args, "diffuse")
}

/// A square picture of about `count` pixels, neither tiny nor huge.
fn square(count: u64) -> Size {
    let side = u32::try_from(count.isqrt()).unwrap_or(u32::MAX).clamp(64, 4096);
    Size { width: side, height: side }
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

/// The primary rays of a picture, traced on the CPU.
struct Picture<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    engine: Intersector,
    size: Size,
}

impl Picture<'_> {
    /// Calls `f` with the rays of each block of rows that hit, and where.
    fn trace(&self, mut f: impl FnMut(usize, &[(Ray, Hit)]) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut hits = Vec::new();
        for rows in row_blocks(self.size, BATCH) {
            let rays: Vec<Ray> = self.camera.rays(self.size.width, self.size.height, rows).collect();
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

    fn count(&self, progress: &Progress) -> Result<u64, Failure> {
        let mut count = 0;
        self.trace(|traced, pairs| {
            progress.add(traced);
            count += pairs.len() as u64;
            Ok(())
        })?;
        Ok(count)
    }

    fn send(&self, shares: Shares, seed: u64, sink: &mut Sink) -> Result<(), Failure> {
        let mut first_hit = 0;
        let mut rays = Vec::new();
        self.trace(|_, pairs| {
            interrupt::check()?;
            if pairs.is_empty() {
                return Ok(());
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
                sink.write(&rays)?;
            }
            first_hit = next_hit;
            Ok(())
        })
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
