//! The error of `t` and the share of wrong verdicts against the distance of a unit sphere.

use glam::Vec3;
use rayproof::scene::{Geometry, Ray, Scene, Sphere};
use rayproof_oracle::families::Draw;

use super::plan::Progress;
use super::{Error, Run};
use crate::model::{DistanceCurve, DistancePoint};

/// Distances a decade, and decades.
const STEPS: i32 = 4;
const DECADES: i32 = 8;

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<DistanceCurve>, Error> {
    let distances: Vec<f64> = (1..=STEPS * DECADES).map(|i| 10_f64.powf(f64::from(i) / f64::from(STEPS))).collect();
    progress.stage("distance", distances.len());
    let curve = |s: &super::subject::Subject| DistanceCurve { precision: s.id(), device: s.device, points: Vec::new() };
    let mut curves: Vec<DistanceCurve> = run.bench.subjects.iter().map(curve).collect();
    for (i, &distance) in distances.iter().enumerate() {
        let (scene, rays) = workload(run.plan.seed, i, distance, run.plan.distance);
        let asked = run.ask(scene, rays);
        for (subject, curve) in run.bench.subjects.iter().zip(&mut curves) {
            let hits = run.bench.closest(*subject, &asked.scene, &asked.rays)?;
            let errors = asked.tally(&hits).errors();
            curve.points.push(DistancePoint { distance, t: errors.t, wrong: errors.wrong });
        }
        progress.step();
    }
    Ok(curves)
}

/// A unit sphere at zero and rays from a distance, all over its disc and a little beyond.
fn workload(seed: u64, number: usize, distance: f64, rays: usize) -> (Scene, Vec<Ray>) {
    let mut draw = Draw::new(seed, 101, number as u64);
    let ray = |draw: &mut Draw| {
        let away = draw.unit();
        let origin = (away * distance).as_vec3();
        let target = draw.across(away) * 1.05 * draw.range(0.0, 1.0).sqrt();
        Ray::new(origin, (target - origin.as_dvec3()).normalize().as_vec3())
    };
    let rays = (0..rays).map(|_| ray(&mut draw)).collect();
    (
        Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])])
            .expect("made of finite numbers"),
        rays,
    )
}
