//! Taking times: everything is run in turn, so that a machine that slows down slows all of them down.

use std::time::Instant;

use rayproof::Error;
use rayproof::scene::{Hit, Ray};

use super::statistics::timing;
use super::subject::Answers;
use crate::model::Timing;

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

    pub(crate) fn kernel_as(&self, unit: impl Fn(f64) -> f64) -> Option<Timing> {
        (!self.kernel.is_empty()).then(|| timing(self.kernel.iter().copied().map(unit).collect()))
    }
}

/// Runs each contestant once to warm up (kernels compile, caches fill), then `runs` times in turn.
pub(crate) fn interleaved(contestants: &[Box<dyn Answers>], rays: &[Ray], runs: u32) -> Result<Vec<Times>, Error> {
    let mut times: Vec<Times> = contestants.iter().map(|_| Times::default()).collect();
    let mut hits = vec![Hit::MISS; rays.len()];
    for run in 0..=runs {
        for (contestant, times) in contestants.iter().zip(&mut times) {
            let before = contestant.kernel_seconds();
            let start = Instant::now();
            contestant.closest(rays, &mut hits)?;
            let wall = start.elapsed().as_secs_f64();
            if run == 0 {
                continue;
            }
            times.wall.push(wall);
            if let (Some(before), Some(after)) = (before, contestant.kernel_seconds()) {
                times.kernel.push(after - before);
            }
        }
    }
    Ok(times)
}
