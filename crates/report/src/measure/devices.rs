//! What ran: its arithmetic, and what exact rules cost there.

use rayproof::measure::Route;
use rayproof::{Device, DeviceChoice, DeviceError, Fingerprint, Precision};

use super::plan::Progress;
use super::statistics::timing;
use super::subject::{Answers, Walk, engines};
use super::timing::times_of;
use super::workloads;
use super::{Error, Run};
use crate::model::{self, Arithmetic, Rule};
use rayproof::scene::{FlatHit, Ray, Scene};

/// A device in words, its arithmetic measured on each route, and the price of exact rules.
pub(crate) fn describe(
    run: &Run<'_>,
    choice: &DeviceChoice,
    device: &Device,
    progress: &mut dyn Progress,
) -> Result<model::Device, Error> {
    let info = device.info(Precision::Fast);
    let kind = if device.is_cpu() {
        "CPU engine"
    } else if device.is_software() {
        "software adapter"
    } else {
        "hardware GPU"
    };
    let mut described = model::Device {
        name: info.name,
        driver: info.driver,
        kind: kind.to_owned(),
        notes: info.notes,
        arithmetic: Vec::new(),
        rules: Vec::new(),
    };
    if device.is_cpu() {
        return Ok(described);
    }
    progress.stage("rules", 2);
    let routes = routes(choice)?;
    described.arithmetic = routes.iter().filter_map(|(_, d)| d.fingerprint()).map(arithmetic).collect();
    for number in [0, 2] {
        let (scene, rays) = workloads::ALL[number].make(run.plan.seed, number, run.plan.panel);
        described.rules.extend(rules(run, &routes, &scene, &rays, workloads::ALL[number].name)?);
        progress.step();
    }
    Ok(described)
}

/// The device anew with each route that it has.
fn routes(choice: &DeviceChoice) -> Result<Vec<(Route, Device)>, rayproof::Error> {
    let mut routes = Vec::new();
    for route in Route::ALL {
        match Device::open_with_route(choice, route) {
            Ok(device) => routes.push((route, device)),
            Err(rayproof::Error::Device(DeviceError::Unsupported { .. })) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(routes)
}

fn arithmetic(f: &Fingerprint) -> Arithmetic {
    let wrong = [
        ("x + y", f.sum_wrong),
        ("x * y", f.product_wrong),
        ("x / y", f.quotient_wrong),
        ("sqrt x", f.root_wrong),
        ("error of x + y", f.sum_error_wrong),
        ("error of x * y", f.product_error_wrong),
        ("x*y - c*(y*x) as written", f.contracted),
        ("comparisons, NaN among them", f.comparisons_wrong),
        ("what may be folded (x 1, x + 0, conversions, choices, vectors)", f.folded),
        ("subnormal results", f.subnormals_wrong),
        ("subnormal operands", f.subnormal_operands_wrong),
        ("subnormals compared", f.subnormal_comparisons_wrong),
    ];
    Arithmetic {
        route: f.route.to_string(),
        pairs: f.pairs as u64,
        wrong: wrong.map(|(name, count)| (name.to_owned(), count as u64)).into(),
        fma_fused: f.fused > 0,
        ieee: f.is_ieee(),
    }
}

/// The kernel of `fast` on each route, every primitive tested with every ray.
fn rules(
    run: &Run<'_>,
    routes: &[(Route, Device)],
    scene: &Scene,
    rays: &[Ray],
    workload: &str,
) -> Result<Vec<Rule>, Error> {
    let ready = routes.iter().map(|(_, device)| engines(device, scene, Precision::Fast, Walk::Every));
    let mut ready = ready.collect::<Result<Vec<Box<dyn Answers>>, _>>()?;
    let mut answers = Vec::new();
    for contestant in &ready {
        let mut hits = vec![FlatHit::MISS; rays.len()];
        contestant.closest(rays, &mut hits)?;
        answers.push(hits);
    }
    let times = times_of(&mut ready, rays, run.plan.runs)?;
    let seconds = |i: usize| if times[i].kernel.is_empty() { &times[i].wall } else { &times[i].kernel };
    let base = routes.iter().position(|(route, _)| *route == Route::ExactSpirv).unwrap_or(0);
    let rule = |(i, (route, _)): (usize, &(Route, Device))| Rule {
        rules: route.to_string(),
        workload: workload.to_owned(),
        different: answers[i].iter().zip(&answers[base]).filter(|(a, b)| !a.same_bits(b)).count() as u64,
        rays: rays.len() as u64,
        ns_per_ray: timing(seconds(i).iter().map(|s| s * 1e9 / rays.len() as f64).collect()),
        ratio: timing(seconds(i).iter().zip(seconds(base)).map(|(own, base)| own / base).collect()),
    };
    Ok(routes.iter().enumerate().map(rule).collect())
}
