//! Does a report find the same again, and does it show a precision that is damaged on purpose?

use rayproof::scene::{FlatHit, MISS, Ray, Scene, Undecided};
use rayproof::{Device, DeviceChoice, Error, Precision};
use rayproof_oracle::families;
use serde_json::Value;

use super::subject::{Answers, Walk, engines};
use super::{Order, Plan, measure};
use crate::model::{Errors, Report};

const TINY: Plan = Plan {
    mode: "tiny",
    seed: 3,
    family: 40,
    panel: 96,
    distance: 16,
    margin: 128,
    leak: 24,
    invariant: 16,
    scene: 256,
    sample: 24,
    primitives: 400,
    runs: 2,
};

pub(crate) fn report(make: &super::Make<'_>) -> Report {
    let order = Order { plan: TINY, devices: vec![DeviceChoice::Cpu], scenes: Vec::new(), peers: None };
    measure(order, make, &mut ()).expect("the CPU engine answers")
}

/// A report of which only the devices are left.
pub(crate) fn without_anything(report: &Report) -> Report {
    Report {
        panels: Vec::new(),
        distance: Vec::new(),
        margins: Vec::new(),
        families: Vec::new(),
        leaks: Vec::new(),
        invariants: Vec::new(),
        scenes: Vec::new(),
        peers: Vec::new(),
        ..report.clone()
    }
}

/// A report as JSON without its timings and its date.
fn without_timings(report: &Report) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(map) if map.contains_key("median") && map.contains_key("runs") => *value = Value::Null,
            Value::Object(map) => map.values_mut().for_each(strip),
            Value::Array(list) => list.iter_mut().for_each(strip),
            _ => {}
        }
    }
    let mut value = serde_json::to_value(Report { date: String::new(), ..report.clone() }).expect("serialises");
    strip(&mut value);
    value
}

#[test]
fn two_runs_agree_in_everything_but_time() {
    let (first, second) = (report(&engines), report(&engines));
    assert_eq!(without_timings(&first), without_timings(&second));
    assert_ne!(first, second, "times are the same to the last bit: nothing was timed");
    let read: Report = serde_json::from_str(&serde_json::to_string(&first).expect("serialises")).expect("reads back");
    assert_eq!(read, first, "every number survives the file");
    assert_eq!(first.families.len(), 42);
    assert_eq!(first.oracles.disagreed, 0);
    assert!(first.oracles.compared > 2000, "{:?}", first.oracles);
    for (exact, what) in errors_of(&first, "exact") {
        assert_eq!((exact.wrong.count, exact.t.max <= 0.5), (0, true), "{what}");
    }
    let replayed = first.families.iter().flat_map(|f| &f.rows).filter_map(|row| row.errors.worst.as_ref());
    let count = replayed.clone().count();
    assert!(count > 100 && replayed.filter(|case| case.replays).count() * 100 > 98 * count);
}

/// The errors of a precision wherever the report has them.
fn errors_of<'r>(report: &'r Report, precision: &'r str) -> Vec<(&'r Errors, String)> {
    let panels = report.panels.iter().flat_map(|panel| panel.points.iter().map(move |p| (p, panel.workload.clone())));
    let panels = panels.filter(|(point, _)| point.precision == precision).map(|(point, name)| (&point.errors, name));
    let families = report.families.iter().flat_map(|f| f.rows.iter().map(move |row| (row, f.name.clone())));
    let families = families.filter(|(row, _)| row.precision == precision).map(|(row, name)| (&row.errors, name));
    panels.chain(families).collect()
}

/// The engines, but for one precision's answers.
struct Damaged<F> {
    sound: Box<dyn Answers>,
    damage: F,
}

impl<F: Fn(&mut FlatHit)> Answers for Damaged<F> {
    fn closest(&self, rays: &[Ray], hits: &mut [FlatHit]) -> Result<Undecided, Error> {
        let undecided = self.sound.closest(rays, hits)?;
        hits.iter_mut().for_each(|hit| (self.damage)(hit));
        Ok(undecided)
    }
    fn crossings(&self, rays: &[Ray], counts: &mut [u32]) -> Option<Result<(), Error>> {
        self.sound.crossings(rays, counts)
    }
    fn kernel_seconds(&self) -> Option<f64> {
        self.sound.kernel_seconds()
    }
    fn build_seconds(&self) -> f64 {
        self.sound.build_seconds()
    }
}

#[test]
fn one_ulp_in_t_shows_everywhere() {
    let make = |device: &Device, scene: &Scene, precision, walk: Walk| -> Result<Box<dyn Answers>, Error> {
        let sound = engines(device, scene, precision, walk)?;
        let damage = |hit: &mut FlatHit| {
            if hit.is_hit() {
                hit.t = hit.t.next_up();
            }
        };
        Ok(if precision == Precision::Exact { Box::new(Damaged { sound, damage }) } else { sound })
    };
    let report = report(&make);
    let mut seen = 0;
    for (errors, what) in errors_of(&report, "exact").into_iter().filter(|(errors, _)| errors.t.n > 0) {
        assert!(errors.t.max > 0.5 && errors.wrong.count == 0, "{what}: {:?}", errors.t);
        seen += 1;
    }
    assert!(seen > 40, "{seen}");
    for curve in report.distance.iter().filter(|curve| curve.precision == "exact") {
        assert!(curve.points.iter().all(|point| point.t.p50 > 0.49), "{:?}", curve.points);
    }
}

#[test]
fn one_misclassified_family_shows_and_no_other() {
    const FAMILY: u32 = 26;
    let family = &families::all()[FAMILY as usize - 1];
    let scenes: Vec<Scene> = family.cases(TINY.seed, TINY.family).into_iter().map(|case| case.scene).collect();
    let make = |device: &Device, scene: &Scene, precision, walk: Walk| -> Result<Box<dyn Answers>, Error> {
        let sound = engines(device, scene, precision, walk)?;
        let damage = |hit: &mut FlatHit| *hit = FlatHit { primitive: MISS, ..FlatHit::MISS };
        let damaged = precision == Precision::Exact && scenes.contains(scene);
        Ok(if damaged { Box::new(Damaged { sound, damage }) } else { sound })
    };
    let report = report(&make);
    for family in &report.families {
        let exact = family.rows.iter().find(|row| row.precision == "exact").expect("is measured");
        let wrong = &exact.errors.misses;
        if family.number == FAMILY {
            assert!(wrong.count == family.hits && family.hits > 0, "{wrong:?}");
            assert!(exact.errors.first_wrong.is_some());
        } else {
            assert_eq!(wrong.count, 0, "family {}", family.number);
        }
    }
}
