//! Who runs: our engines, and the peers they are to beat.

use std::time::{Duration, Instant};

use glam::Vec3A;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::RayHit;
use obvhs::triangle::Triangle as PeerTriangle;
use rayon::prelude::*;
use rayproof::scene::{Geometry, Hit, Ray, Scene, Undecided};
use rayproof::{DeviceChoice, Intersector, Options, Precision};

type Trace = Box<dyn Fn(&[Ray]) -> anyhow::Result<Undecided>>;

/// An engine with a scene in it.
pub(crate) struct Contestant {
    pub(crate) name: &'static str,
    pub(crate) detail: String,
    pub(crate) seconds: f64,
    /// Whom it is to beat.
    pub(crate) peer: Option<&'static str>,
    pub(crate) trace: Trace,
}

type Make = fn(&Scene) -> anyhow::Result<Contestant>;

pub(crate) const ALL: [(&str, Make); 8] = [
    ("obvhs Bvh2", obvhs_bvh2),
    ("cpu fast", |scene| ours(scene, "cpu fast", DeviceChoice::Cpu, Precision::Fast, Some("obvhs Bvh2"))),
    ("cpu exact", |scene| ours(scene, "cpu exact", DeviceChoice::Cpu, Precision::Exact, Some("cpu fast"))),
    ("cpu classic", |scene| ours(scene, "cpu classic", DeviceChoice::Cpu, Precision::Classic, Some("cpu fast"))),
    (crate::plain::NAME, crate::plain::kernel),
    ("gpu fast", |scene| ours(scene, "gpu fast", DeviceChoice::Gpu, Precision::Fast, Some("plain kernel on gpu"))),
    ("gpu exact", |scene| ours(scene, "gpu exact", DeviceChoice::Gpu, Precision::Exact, Some("gpu fast"))),
    ("gpu classic", |scene| ours(scene, "gpu classic", DeviceChoice::Gpu, Precision::Classic, Some("gpu fast"))),
];

fn ours(
    scene: &Scene,
    name: &'static str,
    device: DeviceChoice,
    precision: Precision,
    peer: Option<&'static str>,
) -> anyhow::Result<Contestant> {
    let start = Instant::now();
    let intersector = Intersector::new(scene, &Options { precision, device, ..Options::default() })?;
    let seconds = start.elapsed().as_secs_f64();
    let detail = format!("{}, tree in {:.3} s", intersector.device().name, intersector.build_seconds());
    let hits = std::cell::RefCell::new(Vec::new());
    let trace = move |rays: &[Ray]| {
        let mut hits = hits.borrow_mut();
        hits.resize(rays.len(), Hit::MISS);
        Ok(intersector.closest(rays, &mut hits)?)
    };
    Ok(Contestant { name, detail, seconds, peer, trace: Box::new(trace) })
}

/// obvhs's own two-child tree, traversal and triangle test, medium build, triangles in leaf order, all threads.
fn obvhs_bvh2(scene: &Scene) -> anyhow::Result<Contestant> {
    let [Geometry::Mesh(mesh)] = scene.geometries() else { anyhow::bail!("one mesh only") };
    let start = Instant::now();
    let triangles: Vec<PeerTriangle> = (0..mesh.triangles.len())
        .map(|i| mesh.triangle(i))
        .map(|t| PeerTriangle { v0: t.a.into(), v1: t.b.into(), v2: t.c.into() })
        .collect();
    let bvh = build_bvh2_from_tris(&triangles, obvhs::BvhBuildParams::medium_build(), &mut Duration::default());
    let ordered: Vec<PeerTriangle> = bvh.primitive_indices.iter().map(|&i| triangles[i as usize]).collect();
    let seconds = start.elapsed().as_secs_f64();
    let trace = move |rays: &[Ray]| {
        let hits: Vec<(f32, u32)> = rays
            .par_iter()
            .with_min_len(4096)
            .map(|ray| {
                let peer =
                    obvhs::ray::Ray::new(Vec3A::from(ray.origin), Vec3A::from(ray.direction), ray.t_min, ray.t_max);
                let mut hit = RayHit::none();
                bvh.ray_traverse(peer, &mut hit, |ray, i| ordered[i].intersect(ray));
                (hit.t, hit.primitive_id)
            })
            .collect();
        anyhow::ensure!(hits.len() == rays.len());
        Ok(Undecided::default())
    };
    Ok(Contestant { name: "obvhs Bvh2", detail: "its own".to_owned(), seconds, peer: None, trace: Box::new(trace) })
}
