//! Peers that answer one ray at a time, over all threads.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use rayon::prelude::*;
use rayproof::scene::{FlatHit, Mesh, Ray};

use super::{Absent, Adaptor, Contestant, in_range, same_length};

/// Rays that a thread takes at a time.
const CHUNK: usize = 1024;

/// A peer as its crate offers it.
pub(super) trait Crate: Sized + Send + Sync + 'static {
    const NAME: &'static str;
    const VERSION: &'static str;
    const HOW: &'static str;

    /// The peer with its tree.
    fn build(mesh: &Mesh) -> Result<Self, String>;

    /// Why it cannot answer these rays.
    fn fits(rays: &[Ray]) -> Result<(), String> {
        let _ = rays;
        Ok(())
    }

    /// The first hit of a valid ray.
    fn closest(&self, ray: &Ray) -> FlatHit;

    /// Fills in `u` and `v` of a hit where the query has none. Not timed: nobody who needs only the hit does it.
    fn weigh(&self, ray: &Ray, hit: &mut FlatHit) {
        let _ = (ray, hit);
    }
}

struct Threaded<T> {
    peer: T,
    how: String,
    build_seconds: f64,
    triangles: usize,
}

/// The peer over all threads of the current pool, as our engine runs.
pub(super) fn threaded<T: Crate>(mesh: &Mesh) -> Contestant {
    let start = Instant::now();
    let peer = caught(|| T::build(mesh)).flatten().map_err(|why| Absent::new(T::NAME, why))?;
    let build_seconds = start.elapsed().as_secs_f64();
    let how = format!("{}; threads: {}, {CHUNK} rays at a time", T::HOW, rayon::current_num_threads());
    Ok(Box::new(Threaded { peer, how, build_seconds, triangles: mesh.triangles.len() }))
}

impl<T: Crate> Adaptor for Threaded<T> {
    fn name(&self) -> &str {
        T::NAME
    }

    fn version(&self) -> &str {
        T::VERSION
    }

    fn how(&self) -> &str {
        &self.how
    }

    fn build_seconds(&self) -> f64 {
        self.build_seconds
    }

    fn closest(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<f64, String> {
        same_length(rays.len(), hits.len())?;
        T::fits(rays)?;
        let peer = &self.peer;
        let seconds = caught(|| {
            let start = Instant::now();
            rays.par_chunks(CHUNK).zip(hits.par_chunks_mut(CHUNK)).for_each(|(rays, hits)| {
                for (ray, hit) in rays.iter().zip(hits) {
                    *hit = peer.closest(ray);
                }
            });
            start.elapsed().as_secs_f64()
        })?;
        in_range(hits, self.triangles)?;
        caught(|| {
            let hits = hits.par_iter_mut().zip(rays).filter(|(hit, _)| hit.is_hit());
            hits.for_each(|(hit, ray)| peer.weigh(ray, hit));
        })?;
        Ok(seconds)
    }
}

/// What `ask` returns, or the message of its panic. A peer is only read while it traces, and what it half wrote is not
/// used.
fn caught<R>(ask: impl FnOnce() -> R) -> Result<R, String> {
    catch_unwind(AssertUnwindSafe(ask)).map_err(|panic| format!("it panicked: {}", message(panic.as_ref())))
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}
