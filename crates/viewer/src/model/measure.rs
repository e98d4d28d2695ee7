//! Speed and error of every precision, on the rays of a view.

use std::time::Instant;

use rayproof::scene::{Camera, FlatHit, Ray};
use rayproof::{DeviceError, Error, Precision};

use super::look::Source;
use super::paint::Errors;
use super::world::World;

/// Rays of the view that are taken, at most.
const RAYS: u32 = 30_000;
/// Rounds, all precisions in turn in each.
const ROUNDS: usize = 5;

/// A precision's place in the plot.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub(crate) precision: Precision,
    /// Nanoseconds a ray: the median, the least and the most of the rounds.
    pub(crate) nanoseconds: [f64; 3],
    pub(crate) errors: Errors,
    pub(crate) rays: usize,
}

/// Times every precision that the device has, and compares its answers with those of the precision exact.
///
/// # Errors
/// When the device fails.
pub(crate) fn measure(world: &World, camera: &Camera, size: [u32; 2]) -> Result<Vec<Measured>, Error> {
    let rays = sample(camera, size);
    let mut engines = Vec::new();
    for precision in Precision::ALL {
        match world.engine(Source::device(precision)) {
            Ok(engine) => engines.push((precision, engine)),
            // A device without f64 has no double.
            Err(Error::Device(DeviceError::Unsupported { .. })) => {}
            Err(error) => return Err(error),
        }
    }
    let mut hits = vec![vec![FlatHit::MISS; rays.len()]; engines.len()];
    let mut times = vec![Vec::new(); engines.len()];
    for round in 0..=ROUNDS {
        for (i, (_, engine)) in engines.iter().enumerate() {
            let start = Instant::now();
            engine.closest_flat(&rays, &mut hits[i])?;
            // The first round warms up.
            if round > 0 {
                times[i].push(start.elapsed().as_secs_f64() * 1e9 / rays.len().max(1) as f64);
            }
        }
    }
    let Some(exact) = hits.last() else { return Ok(Vec::new()) };
    let measured = engines.iter().zip(&hits).zip(&mut times).map(|(((precision, _), hits), times)| {
        times.sort_unstable_by(f64::total_cmp);
        let nanoseconds = [times[ROUNDS / 2], times[0], times[ROUNDS - 1]];
        Measured { precision: *precision, nanoseconds, errors: Errors::of(exact, hits), rays: rays.len() }
    });
    Ok(measured.collect())
}

/// Rays through pixels spread evenly over the picture.
fn sample(camera: &Camera, [width, height]: [u32; 2]) -> Vec<Ray> {
    let all = u64::from(width) * u64::from(height);
    let step = (1_u32..).find(|&step| all / u64::from(step * step) <= u64::from(RAYS)).unwrap_or(1) as usize;
    let pixels = camera.pixels(width, height);
    let rows = (0..height).step_by(step);
    rows.flat_map(|y| (0..width).step_by(step).map(move |x| pixels.ray(x, y))).collect()
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]

    use rayproof::Device;

    use super::*;

    #[test]
    fn every_precision_is_measured_and_exact_is_right() {
        let world = World::welcome(Device::cpu());
        let far = crate::model::navigate::walk_away(&world.camera, &world.scene, 4.0);
        let measured = measure(&world, &far, [400, 300]).unwrap();
        assert_eq!(measured.iter().map(|m| m.precision).collect::<Vec<_>>(), Precision::ALL);
        for m in &measured {
            assert_eq!(m.rays, m.errors.verdicts.iter().sum::<usize>());
            assert!(m.nanoseconds[0] > 0.0 && m.nanoseconds[1] <= m.nanoseconds[0] && m.rays > 10_000);
        }
        assert_eq!((measured[5].errors.wrong(), measured[5].errors.ulps), (0, Some([0; 3])));
        assert!(measured[0].errors.ulps.unwrap()[2] > 100, "textbook is too good at 1e4: {measured:?}");
    }
}
