//! wgpu's ray query: the hardware's own intersector.

use std::time::Instant;

use rayproof::scene::{FlatHit, Mesh, Ray};
use rayproof_gpu::{RayQuery, Selector};

use super::{Absent, Adaptor, Contestant, in_range, same_length};

const NAME: &str = "wgpu ray query";

/// The ray query of a hardware GPU that has one; on a software adapter it would be a peer in name only.
pub fn ray_query_peer(mesh: &Mesh, selector: &Selector) -> Contestant {
    let query = RayQuery::new(selector, mesh).map_err(|e| Absent::new(NAME, e.to_string()))?;
    let version = query.driver();
    Ok(Box::new(RayQueryPeer { query, version, triangles: mesh.triangles.len() }))
}

/// This peer where it is not measured, because of `why`.
pub fn absent_ray_query(why: &str) -> Contestant {
    Err(Absent::new(NAME, why))
}

struct RayQueryPeer {
    query: RayQuery,
    version: String,
    triangles: usize,
}

impl Adaptor for RayQueryPeer {
    fn name(&self) -> &str {
        NAME
    }

    fn version(&self) -> &str {
        &self.version
    }

    fn how(&self) -> &str {
        "one opaque bottom level in one instance, PREFER_FAST_TRACE, a ray query a thread in plain WGSL; end to end: rays up, hits back"
    }

    fn build_seconds(&self) -> f64 {
        self.query.build_seconds()
    }

    fn closest(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<f64, String> {
        same_length(rays.len(), hits.len())?;
        let start = Instant::now();
        self.query.closest(rays, hits).map_err(|e| e.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        in_range(hits, self.triangles)?;
        Ok(seconds)
    }
}
