//! Family by family against the oracle: the same primitive, every number correctly rounded, every crossing counted.

use rayproof::scene::{Ray, Undecided};
use rayproof_oracle::families::{self, Case};

use super::{Answers, Engines, Truth, rays, truth};
use crate::device::gpu;

const SEED: u64 = 11;

/// What came of a family.
#[derive(Default)]
struct Tally {
    rays: usize,
    hits: usize,
    crossings: u64,
    /// Rays that a device answered too.
    on_device: usize,
    wrong: Vec<String>,
    undecided: Undecided,
}

fn compare(case: &Case, tally: &mut Tally) {
    let engines = Engines::new(&case.scene);
    let truth = truth(&case.scene, &case.rays);
    let cpu = engines.on_cpu(&case.rays);
    tally.undecided += cpu.undecided;
    judge("cpu", &case.rays, &cpu, &truth, tally);
    if let Some(device) = engines.on_device(&case.rays) {
        if gpu().fingerprint().is_ieee() {
            assert_eq!(device.undecided.first_stage, cpu.undecided.first_stage, "the first stage's open rays");
        }
        judge("device", &case.rays, &device, &truth, tally);
        tally.on_device += case.rays.len();
    }
    tally.rays += case.rays.len();
    tally.hits += truth.iter().filter(|truth| truth.hit.is_hit()).count();
    tally.crossings += truth.iter().map(|truth| u64::from(truth.count)).sum::<u64>();
}

fn judge(engine: &str, rays: &[Ray], answers: &Answers, truth: &[Truth], tally: &mut Tally) {
    for (i, Truth { hit, count }) in truth.iter().enumerate() {
        let (found, any, counted) = (answers.hits[i], answers.any[i], answers.counts[i]);
        if !found.same_bits(hit) || any != u8::from(hit.is_hit()) || counted != *count {
            let wrong = format!("{found:?}, any {any}, count {counted}\n  {hit:?}, count {count}");
            tally.wrong.push(format!("{engine}: {:?}:\n  {wrong}", rays[i]));
        }
    }
}

#[test]
fn exact_is_exact_over_all_families() {
    println!("seed {SEED}");
    let mut broken = Vec::new();
    for family in families::all() {
        let mut tally = Tally::default();
        for case in family.cases(SEED, rays(2_000, 100_000)) {
            compare(&case, &mut tally);
        }
        let Undecided { first_stage, after_refine, .. } = tally.undecided;
        println!(
            "family {:>2} {:<24} {:>6} rays, {:>6} on the device, {:>6} hit, {:>7} crossings, {} wrong; open after f32 \
             {first_stage:>6}, after f64 {after_refine:>6}",
            family.number,
            family.name,
            tally.rays,
            tally.on_device,
            tally.hits,
            tally.crossings,
            tally.wrong.len(),
        );
        let wrong = tally.wrong.len();
        broken.extend(tally.wrong.into_iter().take(1).map(|case| format!("family {}: {wrong}\n{case}", family.number)));
    }
    assert!(broken.is_empty(), "{} families are not exact\n{}", broken.len(), broken.join("\n"));
}
