//! Speed against error on the workloads.

use rayproof::scene::{FlatHit, Ray, Scene};

use super::case::errors;
use super::plan::Progress;
use super::subject::{Answers, Subject, Walk, fast_of};
use super::timing::{Times, times_of};
use super::workloads::{self, PRIMITIVES, Workload};
use super::{Error, Run};
use crate::model::{Panel, Point};

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<Panel>, Error> {
    progress.stage("speed against error", workloads::ALL.len());
    let mut panels = Vec::new();
    for (i, workload) in workloads::ALL.iter().enumerate() {
        panels.push(panel(run, workload, i)?);
        progress.step();
    }
    Ok(panels)
}

fn panel(run: &mut Run<'_>, workload: &Workload, number: usize) -> Result<Panel, Error> {
    let (scene, rays) = workload.make(run.plan.seed, number, run.plan.panel);
    let subjects = run.bench.subjects_on(workload.primitive == "sphere");
    let every = times(run, &subjects, &scene, &rays, Walk::Every)?;
    let tree = times(run, &subjects, &scene, &rays, Walk::Tree)?;
    let asked = [run.ask(scene, rays)];
    let mut points = Vec::new();
    for (i, (&subject, tree)) in subjects.iter().zip(&tree).enumerate() {
        let (own, fast) = (&every[i], &every[fast_of(&subjects, subject)]);
        let hits: Vec<FlatHit> = run.bench.closest(subject, &asked[0].scene, &asked[0].rays)?;
        let tally = asked[0].tally(&hits);
        let rays = asked[0].rays.len() as f64;
        let ns = |seconds: f64| seconds * 1e9 / (rays * PRIMITIVES as f64);
        points.push(Point {
            precision: subject.id(),
            device: subject.device,
            errors: errors(&run.bench, subject, &asked, tally)?,
            kernel_ns: own.kernel_as(ns),
            ns: own.wall_as(ns),
            of_fast: own.over(fast),
            mrays: tree.wall_as(|seconds| rays / seconds / 1e6),
        });
    }
    Ok(Panel { primitive: workload.primitive.to_owned(), workload: workload.name.to_owned(), points })
}

fn times(run: &Run<'_>, subjects: &[Subject], scene: &Scene, rays: &[Ray], walk: Walk) -> Result<Vec<Times>, Error> {
    let mut ready =
        subjects.iter().map(|&s| run.bench.ready(s, scene, walk)).collect::<Result<Vec<Box<dyn Answers>>, _>>()?;
    times_of(&mut ready, rays, run.plan.runs)
}
