//! Embree, by its two Python packages.

use std::path::Path;
use std::thread;

use rayproof::scene::{FlatHit, Mesh, Ray};

use super::child::Child;
use super::venv::python_of;
use super::{Absent, Adaptor, Contestant, from_zero, in_range, same_length};

const SCRIPT: &str = include_str!("embree.py");

/// One way to call Embree.
struct Kind {
    /// As the script calls it.
    id: &'static str,
    name: &'static str,
    how: &'static str,
    /// Whether it uses all threads.
    threads: bool,
    counts: bool,
}

const KINDS: [Kind; 3] = [
    Kind {
        id: "open3d",
        name: "Embree robust (Open3D)",
        how: "RaycastingScene.cast_rays and count_intersections; it sets RTC_SCENE_FLAG_ROBUST itself",
        threads: true,
        counts: true,
    },
    Kind {
        id: "embreex",
        name: "Embree (embreex)",
        how: "EmbreeScene().run(output=True), rtcIntersect1 ray by ray in Cython, as trimesh calls it",
        threads: false,
        counts: false,
    },
    Kind {
        id: "embreex-robust",
        name: "Embree robust (embreex)",
        how: "EmbreeScene(robust=True).run(output=True), rtcIntersect1 ray by ray in Cython",
        threads: false,
        counts: false,
    },
];

/// Embree by Open3D and by embreex, each with its tree of the mesh in a child process of the environment's Python.
#[must_use]
pub fn python_peers(mesh: &Mesh, venv: &Path) -> Vec<Contestant> {
    KINDS.iter().map(|kind| Embree::start(kind, mesh, venv)).collect()
}

/// These peers where there is no virtual environment, because of `why`.
#[must_use]
pub fn absent_python_peers(why: &str) -> Vec<Contestant> {
    KINDS.iter().map(|kind| Err(Absent::new(kind.name, why))).collect()
}

struct Embree {
    kind: &'static Kind,
    how: String,
    child: Child,
    triangles: usize,
}

impl Embree {
    fn start(kind: &'static Kind, mesh: &Mesh, venv: &Path) -> Contestant {
        let vertices = bytemuck::cast_slice(&mesh.vertices);
        let triangles = bytemuck::cast_slice(&mesh.triangles);
        let files = [("vertices", vertices), ("triangles", triangles)];
        let child = Child::start(&python_of(venv), SCRIPT, &[kind.id], &files);
        let child = child.map_err(|why| Absent::new(kind.name, why))?;
        let threads = if kind.threads { thread::available_parallelism().map_or(1, usize::from) } else { 1 };
        let how = format!("{}; threads: {threads}, timed in Python around the call alone", kind.how);
        Ok(Box::new(Self { kind, how, child, triangles: mesh.triangles.len() }))
    }
}

impl Adaptor for Embree {
    fn name(&self) -> &str {
        self.kind.name
    }

    fn version(&self) -> &str {
        &self.child.version
    }

    fn how(&self) -> &str {
        &self.how
    }

    fn build_seconds(&self) -> f64 {
        self.child.build_seconds
    }

    fn closest(&mut self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<f64, String> {
        same_length(rays.len(), hits.len())?;
        from_zero(rays)?;
        if rays.is_empty() {
            return Ok(0.0);
        }
        let seconds = self.child.ask("closest", bytemuck::cast_slice(rays), bytemuck::cast_slice_mut(hits))?;
        in_range(hits, self.triangles)?;
        // Neither call has an end of rays; what is closest is closest of what is within it, too.
        for (hit, _) in hits.iter_mut().zip(rays).filter(|(hit, ray)| hit.t > ray.t_max) {
            *hit = FlatHit::MISS;
        }
        Ok(seconds)
    }

    fn count(&mut self, rays: &[Ray], counts: &mut [u32]) -> Option<Result<f64, String>> {
        self.kind.counts.then(|| {
            same_length(rays.len(), counts.len())?;
            from_zero(rays)?;
            if rays.is_empty() {
                return Ok(0.0);
            }
            if rays.iter().any(|ray| ray.t_max < f32::INFINITY) {
                return Err("it counts along whole rays only, and one has an end".to_owned());
            }
            self.child.ask("count", bytemuck::cast_slice(rays), bytemuck::cast_slice_mut(counts))
        })
    }
}
