//! Other people's intersectors, asked as their own users ask them: the same rays as ours, in the same run.
//!
//! A peer that cannot be built, dies, panics or answers nonsense is an [`Absent`] or an `Err` that says why, never the
//! end of the report.

#[cfg(feature = "peers")]
mod bvh;
mod child;
#[cfg(feature = "peers")]
mod obvhs;
#[cfg(feature = "peers")]
mod parry;
mod python;
mod ray_query;
mod rust;
#[cfg(test)]
mod tests;
#[cfg(feature = "peers")]
mod threads;
mod venv;

pub use python::{absent_python_peers, python_peers};
pub use ray_query::{absent_ray_query, ray_query_peer};
pub use rust::{absent_rust_peers, rust_peers};
pub use venv::make_venv;

use rayproof::scene::{FlatHit, Ray};

/// Another intersector with the tree of one mesh.
pub trait Adaptor: Send {
    /// Its name, such as `Embree robust (Open3D)`.
    fn name(&self) -> &str;

    /// The version that answers.
    fn version(&self) -> &str;

    /// How it is called: what of its interface, with which flags, on how many threads, and what is done to its answers.
    fn how(&self) -> &str;

    /// Seconds from the mesh in memory to being ready for rays.
    fn build_seconds(&self) -> f64;

    /// The first hit of each ray: its primitive as the mesh numbers it, `t` in multiples of the direction, `u` and `v`.
    /// Returns the seconds of tracing alone: no files, no conversion of whole batches, no checks.
    ///
    /// # Errors
    /// Why there is no answer: the lengths differ, a ray starts elsewhere than at `t = 0` where the peer cannot, or the
    /// peer failed. `hits` then holds nothing of use.
    fn closest(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<f64, String>;

    /// How often each ray crosses the mesh, as [`closest`](Self::closest) answers; `None` where the peer has no such
    /// query.
    fn count(&mut self, rays: &[Ray], counts: &mut [u32]) -> Option<Result<f64, String>> {
        let _ = (rays, counts);
        None
    }
}

/// A peer, or why there is none.
pub type Contestant = Result<Box<dyn Adaptor>, Absent>;

/// A peer that cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name}: not measured: {why}")]
pub struct Absent {
    /// Its name.
    pub name: String,
    /// What failed.
    pub why: String,
}

impl Absent {
    fn new(name: &str, why: impl Into<String>) -> Self {
        Self { name: name.to_owned(), why: why.into() }
    }
}

/// That there is a place for the answer of each ray.
fn same_length(rays: usize, answers: usize) -> Result<(), String> {
    if rays == answers { Ok(()) } else { Err(format!("{rays} rays and room for {answers} answers")) }
}

/// That every ray starts at `t = 0`, for peers that take no other start.
fn from_zero(rays: &[Ray]) -> Result<(), String> {
    let other = rays.iter().find(|ray| ray.t_min != 0.0);
    other.map_or(Ok(()), |ray| Err(format!("it starts rays at t = 0 only, and one starts at {}", ray.t_min)))
}

/// That every hit names one of so many triangles.
fn in_range(hits: &[FlatHit], triangles: usize) -> Result<(), String> {
    let outside = |hit: &&FlatHit| hit.is_hit() && hit.primitive as usize >= triangles;
    let found = hits.iter().find(outside);
    found.map_or(Ok(()), |hit| Err(format!("it names triangle {} of {triangles}", hit.primitive)))
}
