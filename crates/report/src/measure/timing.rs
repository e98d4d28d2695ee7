//! Taking times: everything is run in turn, so that a machine that slows down slows all of them down.

use std::time::Instant;

use rayproof::scene::{FlatHit, Ray};

use super::Error;
use super::statistics::timing;
use super::subject::Answers;
use crate::model::Timing;
use crate::peers::Adaptor;

/// The times of one contestant, in seconds, a run each.
#[derive(Default)]
pub(crate) struct Times {
    /// From the first ray handed over to the last hit back.
    pub(crate) wall: Vec<f64>,
    /// By the device's own clock; empty where it has none.
    pub(crate) kernel: Vec<f64>,
}

impl Times {
    /// In another unit.
    pub(crate) fn wall_as(&self, unit: impl Fn(f64) -> f64) -> Timing {
        timing(self.wall.iter().copied().map(unit).collect())
    }

    /// How its times compare with another's, run by run.
    pub(crate) fn over(&self, other: &Self) -> Timing {
        timing(self.wall.iter().zip(&other.wall).map(|(own, other)| own / other).collect())
    }

    pub(crate) fn kernel_as(&self, unit: impl Fn(f64) -> f64) -> Option<Timing> {
        (!self.kernel.is_empty()).then(|| timing(self.kernel.iter().copied().map(unit).collect()))
    }
}

/// One run.
pub(crate) struct Taken {
    wall: f64,
    kernel: Option<f64>,
}

/// What can be timed: one of our precisions, or a peer.
pub(crate) trait Timed {
    /// Answers the rays.
    fn take(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Taken, Error>;
}

impl Timed for Box<dyn Answers> {
    fn take(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Taken, Error> {
        let before = self.kernel_seconds();
        let start = Instant::now();
        self.closest(rays, hits)?;
        let wall = start.elapsed().as_secs_f64();
        let kernel = before.zip(self.kernel_seconds()).map(|(before, after)| after - before);
        Ok(Taken { wall, kernel })
    }
}

impl Timed for Box<dyn Adaptor> {
    fn take(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Taken, Error> {
        let wall = (**self).closest(rays, hits).map_err(Error::Peer)?;
        Ok(Taken { wall, kernel: None })
    }
}

/// Runs each contestant once to warm up (kernels compile, caches fill), then `runs` times in turn. One that fails is out.
pub(crate) fn interleaved(contestants: &mut [&mut dyn Timed], rays: &[Ray], runs: u32) -> Vec<Result<Times, Error>> {
    let mut times: Vec<Result<Times, Error>> = contestants.iter().map(|_| Ok(Times::default())).collect();
    let mut hits = vec![FlatHit::MISS; rays.len()];
    for run in 0..=runs {
        for (contestant, slot) in contestants.iter_mut().zip(&mut times) {
            let Ok(times) = slot else { continue };
            match contestant.take(rays, &mut hits) {
                Ok(taken) if run > 0 => {
                    times.wall.push(taken.wall);
                    times.kernel.extend(taken.kernel);
                }
                Ok(_) => {}
                Err(e) => *slot = Err(e),
            }
        }
    }
    times
}

/// The times of our precisions, none of which may fail.
pub(crate) fn times_of(ready: &mut [Box<dyn Answers>], rays: &[Ray], runs: u32) -> Result<Vec<Times>, Error> {
    let mut contestants: Vec<&mut dyn Timed> = ready.iter_mut().map(|r| r as &mut dyn Timed).collect();
    interleaved(&mut contestants, rays, runs).into_iter().collect()
}
