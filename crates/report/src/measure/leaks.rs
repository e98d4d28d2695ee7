//! Rays from inside closed meshes, aimed exactly at vertices and edges.

use glam::DVec3;
use rayproof::Error;
use rayproof::scene::{Geometry, Hit, Mesh, Ray, Scene};
use rayproof_oracle::Oracle;
use rayproof_oracle::families::{Draw, meshes};

use super::Run;
use super::plan::Progress;
use super::statistics::rate;
use super::subject::Walk;
use crate::model::Leaks;

/// What rays are aimed at.
const TARGETS: [&str; 2] = ["vertices", "edges"];

/// A closed mesh with the origin inside, seen from which every part of it is in view or behind another.
fn closed() -> [(&'static str, Mesh); 3] {
    [("bumpy sphere", meshes::bumpy_sphere(16, 16, 5)), ("icosphere", meshes::icosphere(3)), ("box", meshes::cube(8))]
}

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<Leaks>, Error> {
    let closed = closed();
    progress.stage("leaks", closed.len() * TARGETS.len());
    let mut rows = Vec::new();
    for (number, (name, mesh)) in closed.into_iter().enumerate() {
        let triangles = mesh.triangles.len() as u64;
        for target in TARGETS {
            let rays = aimed(&mesh, target, run.plan.leak, &mut Draw::new(run.plan.seed, 103, number as u64));
            let scene = Scene::new(vec![Geometry::Mesh(mesh.clone())]);
            run.agree(&scene, &rays);
            let crossings = Oracle::new(&scene).batch(&rays, Oracle::count);
            for &subject in &run.bench.subjects {
                let ready = run.bench.ready(subject, &scene, Walk::Tree)?;
                let mut hits = vec![Hit::MISS; rays.len()];
                ready.closest(&rays, &mut hits)?;
                let mut counts = vec![0; rays.len()];
                let counted = ready.crossings(&rays, &mut counts).transpose()?.is_some();
                let who = run.bench.name(subject);
                rows.push(leaks((name, triangles, target, who), &hits, counted.then_some((&counts, &crossings))));
            }
            progress.step();
        }
    }
    Ok(rows)
}

/// A row: leaks by the closest hits, and what is wrong with the counts, where there are any, against the exact ones.
pub(crate) fn leaks(
    (mesh, triangles, target, who): (&str, u64, &str, String),
    hits: &[Hit],
    counts: Option<(&Vec<u32>, &Vec<u32>)>,
) -> Leaks {
    let rays = hits.len() as u64;
    let share = |count: usize| rate(count as u64, rays);
    Leaks {
        mesh: mesh.to_owned(),
        triangles,
        target: target.to_owned(),
        who,
        leaked: share(hits.iter().filter(|hit| !hit.is_hit()).count()),
        even: counts.map(|(counts, _)| share(counts.iter().filter(|count| count.is_multiple_of(2)).count())),
        double: counts
            .map(|(counts, exact)| share(counts.iter().zip(exact).filter(|(count, exact)| count > exact).count())),
    }
}

/// Rays from near the middle at vertices, or at points of edges; the closest `f32` to them.
pub(crate) fn aimed(mesh: &Mesh, target: &str, count: usize, draw: &mut Draw) -> Vec<Ray> {
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
