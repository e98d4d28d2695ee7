//! Rays from inside closed meshes, aimed exactly at vertices and edges.

use glam::DVec3;
use rayproof::scene::{FlatHit, Geometry, Mesh, Ray, Scene};
use rayproof::{Device, DeviceChoice, Intersector, Precision};
use rayproof_oracle::Oracle;
use rayproof_oracle::families::{Draw, meshes};

use super::plan::Progress;
use super::statistics::rate;
use super::subject::{Subject, Walk};
use super::{Error, Run};
use crate::model::Leaks;
use crate::peers::Adaptor;

/// Triangles up to which the oracle counts.
const BRUTE_FORCE: usize = 10_000;

/// What rays are aimed at.
const TARGETS: [&str; 2] = ["vertices", "edges"];

/// A closed mesh with the origin inside, seen from which every part of it is in view or behind another.
fn closed() -> [(&'static str, Mesh); 3] {
    [("bumpy sphere", meshes::bumpy_sphere(16, 16, 5)), ("icosphere", meshes::icosphere(3)), ("box", meshes::cube(8))]
}

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<Leaks>, Error> {
    let mut closed: Vec<(&str, Mesh)> = closed().into();
    if run.rivals.is_asked() {
        closed.push(("fine sphere", meshes::uv_sphere(518, 259)));
    }
    progress.stage("leaks", closed.len() * TARGETS.len());
    let mut rows = Vec::new();
    for (number, (name, mesh)) in closed.into_iter().enumerate() {
        let scene = Scene::new(vec![Geometry::Mesh(mesh.clone())]).expect("made of finite numbers");
        let mut peers = run.rivals.on(&scene);
        for target in TARGETS {
            let rays = aimed(&mesh, target, run.plan.leak, &mut Draw::new(run.plan.seed, 103, number as u64));
            let target = (name, mesh.triangles.len() as u64, target);
            let crossings = crossings(run, &scene, &rays)?;
            for subject in run.bench.subjects_on(false) {
                rows.push(ours(run, subject, &scene, &rays, &crossings, target)?);
            }
            for peer in &mut peers {
                rows.extend(theirs(run, peer.as_mut(), &rays, &crossings, target));
            }
            progress.step();
        }
    }
    Ok(rows)
}

/// How often each ray crosses: by the oracle; on a fine mesh, where brute force takes hours, by the precision exact.
fn crossings(run: &mut Run<'_>, scene: &Scene, rays: &[Ray]) -> Result<Vec<u32>, Error> {
    if scene.len() <= BRUTE_FORCE {
        run.add(rayproof_oracle::compare(scene, rays));
        return Ok(Oracle::new(scene).batch(rays, Oracle::count));
    }
    let mut counts = vec![0; rays.len()];
    Intersector::on(&Device::open(&DeviceChoice::Cpu)?, scene, Precision::Exact)?.count(rays, &mut counts)?;
    Ok(counts)
}

/// A mesh's name, its triangles, and what is aimed at.
type Target<'p> = (&'p str, u64, &'p str);

fn ours(
    run: &Run<'_>,
    subject: Subject,
    scene: &Scene,
    rays: &[Ray],
    crossings: &[u32],
    target: Target<'_>,
) -> Result<Leaks, Error> {
    let ready = run.bench.ready(subject, scene, Walk::Tree)?;
    let mut hits = vec![FlatHit::MISS; rays.len()];
    ready.closest(rays, &mut hits)?;
    let mut counts = vec![0; rays.len()];
    let counted = ready.crossings(rays, &mut counts).transpose()?.is_some();
    Ok(leaks(target, run.bench.name(subject), &hits, counted.then_some((&counts, crossings))))
}

fn theirs(
    run: &mut Run<'_>,
    peer: &mut dyn Adaptor,
    rays: &[Ray],
    crossings: &[u32],
    target: Target<'_>,
) -> Option<Leaks> {
    let mut hits = vec![FlatHit::MISS; rays.len()];
    let mut counts = vec![0; rays.len()];
    let asked = peer.closest(rays, &mut hits).and_then(|_| peer.count(rays, &mut counts).transpose());
    match asked {
        Ok(counted) => Some(leaks(target, peer.name().to_owned(), &hits, counted.map(|_| (&counts[..], crossings)))),
        Err(why) => {
            run.rivals.absent(peer.name(), &why);
            None
        }
    }
}

/// A row: leaks by the closest hits, and what is wrong with the counts, where there are any, against the exact ones.
fn leaks((mesh, triangles, at): Target<'_>, who: String, hits: &[FlatHit], counts: Option<(&[u32], &[u32])>) -> Leaks {
    let rays = hits.len() as u64;
    let share = |count: usize| rate(count as u64, rays);
    Leaks {
        mesh: mesh.to_owned(),
        triangles,
        target: at.to_owned(),
        who,
        leaked: share(hits.iter().filter(|hit| !hit.is_hit()).count()),
        even: counts.map(|(counts, _)| share(counts.iter().filter(|count| count.is_multiple_of(2)).count())),
        double: counts
            .map(|(counts, exact)| share(counts.iter().zip(exact).filter(|(count, exact)| count > exact).count())),
    }
}

/// Rays from near the middle at vertices, or at points of edges; the closest `f32` to them.
fn aimed(mesh: &Mesh, target: &str, count: usize, draw: &mut Draw) -> Vec<Ray> {
    let ray = |draw: &mut Draw| {
        let corners = mesh.triangles[draw.below(mesh.triangles.len())];
        let k = draw.below(3);
        let [a, b] = [corners[k], corners[(k + 1) % 3]].map(|v| mesh.vertices[v as usize].as_dvec3());
        let point = if target == "vertices" { a } else { a.lerp(b, draw.range(0.0, 1.0)).as_vec3().as_dvec3() };
        let origin = (draw.unit() * 0.1 * draw.range(0.0, 1.0).cbrt()).as_vec3();
        let direction = (point - origin.as_dvec3()).as_vec3();
        Ray::new(origin, if direction == glam::Vec3::ZERO { DVec3::X.as_vec3() } else { direction })
    };
    (0..count).map(|_| ray(draw)).collect()
}
