//! Changes that leave real arithmetic's answer alone: the order of vertices, the order of axes, a power of two.

use glam::Vec3;
use rayproof::scene::{FlatHit, Geometry, Mesh, Ray, Scene, Sphere};

use super::plan::Progress;
use super::statistics::rate;
use super::workloads::{self, Workload};
use super::{Error, Run};
use crate::model::Invariant;

/// A change, and what it multiplies `t` by.
struct Change {
    name: &'static str,
    /// To points: origins, centres, vertices.
    point: fn(Vec3) -> Vec3,
    /// To directions.
    direction: fn(Vec3) -> Vec3,
    /// To radii and to `t`.
    scale: f32,
    /// The order in which a triangle's vertices come.
    order: [usize; 3],
}

const SCALE: f32 = 1024.0;

fn same(v: Vec3) -> Vec3 {
    v
}

fn turned(v: Vec3) -> Vec3 {
    Vec3::new(v.y, v.z, v.x)
}

fn swapped(v: Vec3) -> Vec3 {
    Vec3::new(v.y, v.x, v.z)
}

static CHANGES: [Change; 7] = [
    Change { name: "vertex order", point: same, direction: same, scale: 1.0, order: [1, 2, 0] },
    Change { name: "vertex order", point: same, direction: same, scale: 1.0, order: [2, 0, 1] },
    Change { name: "vertex order", point: same, direction: same, scale: 1.0, order: [0, 2, 1] },
    Change { name: "axis order", point: turned, direction: turned, scale: 1.0, order: [0, 1, 2] },
    Change { name: "axis order", point: swapped, direction: swapped, scale: 1.0, order: [0, 1, 2] },
    Change { name: "scale by 2^10", point: |v| v * SCALE, direction: same, scale: SCALE, order: [0, 1, 2] },
    Change { name: "scale by 2^-10", point: |v| v / SCALE, direction: same, scale: 1.0 / SCALE, order: [0, 1, 2] },
];

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<Invariant>, Error> {
    progress.stage("invariants", workloads::ALL.len());
    let mut rows: Vec<Invariant> = Vec::new();
    for (number, workload) in workloads::ALL.iter().enumerate() {
        one(run, workload, number, &mut rows)?;
        progress.step();
    }
    Ok(rows)
}

/// Adds a workload to the rows: those of one change, primitive, precision and device are one.
fn one(run: &Run<'_>, workload: &Workload, number: usize, rows: &mut Vec<Invariant>) -> Result<(), Error> {
    let (scene, rays) = workload.make(run.plan.seed + 1, number, run.plan.invariant);
    let of_triangles = workload.primitive == "triangle";
    for subject in run.bench.subjects_on(!of_triangles) {
        let before = run.bench.closest(subject, &scene, &rays)?;
        for change in CHANGES.iter().filter(|change| of_triangles || change.order == [0, 1, 2]) {
            let (changed, changed_rays) = change.apply(&scene, &rays);
            let after = run.bench.closest(subject, &changed, &changed_rays)?;
            let found = Found::compare(&before, &after, change.scale);
            let row = Invariant {
                change: change.name.to_owned(),
                primitive: workload.primitive.to_owned(),
                precision: subject.id(),
                device: subject.device,
                verdict: rate(found.verdicts, found.rays),
                t: rate(found.ts, found.both),
            };
            let is_same = |old: &&mut Invariant| {
                (&old.change, &old.primitive, &old.precision, old.device)
                    == (&row.change, &row.primitive, &row.precision, row.device)
            };
            match rows.iter_mut().find(is_same) {
                Some(old) => {
                    old.verdict = rate(old.verdict.count + found.verdicts, old.verdict.of + found.rays);
                    old.t = rate(old.t.count + found.ts, old.t.of + found.both);
                }
                None => rows.push(row),
            }
        }
    }
    Ok(())
}

impl Change {
    fn apply(&self, scene: &Scene, rays: &[Ray]) -> (Scene, Vec<Ray>) {
        let geometry = |geometry: &Geometry| match geometry {
            Geometry::Spheres(spheres) => {
                let moved = |s: &Sphere| Sphere { center: (self.point)(s.center), radius: s.radius * self.scale };
                Geometry::Spheres(spheres.iter().map(moved).collect())
            }
            Geometry::Mesh(mesh) => Geometry::Mesh(Mesh {
                vertices: mesh.vertices.iter().copied().map(self.point).collect(),
                triangles: mesh.triangles.iter().map(|corners| self.order.map(|k| corners[k])).collect(),
            }),
        };
        let ray =
            |ray: &Ray| Ray { origin: (self.point)(ray.origin), direction: (self.direction)(ray.direction), ..*ray };
        (
            Scene::new(scene.geometries().iter().map(geometry).collect()).expect("made of finite numbers"),
            rays.iter().map(ray).collect(),
        )
    }
}

/// What changed.
#[derive(Default)]
struct Found {
    rays: u64,
    verdicts: u64,
    both: u64,
    ts: u64,
}

impl Found {
    fn compare(before: &[FlatHit], after: &[FlatHit], scale: f32) -> Self {
        let mut found = Self::default();
        for (before, after) in before.iter().zip(after) {
            found.rays += 1;
            found.verdicts += u64::from(before.primitive != after.primitive);
            if before.is_hit() && before.primitive == after.primitive {
                found.both += 1;
                found.ts += u64::from((before.t * scale).to_bits() != after.t.to_bits());
            }
        }
        found
    }
}
