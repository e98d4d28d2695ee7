//! The precision `fast` against exact arithmetic, family by family, on the CPU and on the device: nothing beyond what the precision
//! promises.

use rayproof::Precision;
use rayproof::scene::{FlatHit, Ray};
use rayproof_cpu::Engine;
use rayproof_gpu::Engine as Device;
use rayproof_oracle::Oracle;
use rayproof_oracle::families::{self, Case};
use rayproof_oracle::judge::{Verdict, judge_any, judge_closest};
use rayproof_tree::{Bvh, Scaling};

use crate::device::gpu;

const SEED: u64 = 7;
const RAYS_PER_FAMILY: usize = 2_000;

/// What the judge said of a family.
#[derive(Default)]
struct Tally {
    exact: usize,
    within: usize,
    /// The worst error of t in ULP, and the largest share of the promise that any error took.
    ulp: u64,
    share: f64,
    wrong: Vec<String>,
    /// Rays that the device answered, too.
    on_device: usize,
}

impl Tally {
    fn see(&mut self, engine: &str, verdict: &Verdict) {
        match verdict {
            Verdict::Exact(errors) => {
                self.exact += 1;
                self.ulp = self.ulp.max(errors.t);
                self.share = self.share.max(errors.of_promise);
            }
            Verdict::WithinPromise(_) => self.within += 1,
            Verdict::Disagrees(..) => self.wrong.push(format!("{engine}: {verdict}")),
        }
    }
}

fn judge(case: &Case, tally: &mut Tally) {
    let oracle = Oracle::new(&case.scene);
    let bvh = Bvh::new(&case.scene, Scaling::of(Precision::Fast)).expect("small");
    let refused = gpu().refuses(Precision::Fast, &bvh).expect("asked");
    let device =
        refused.is_none().then(|| Device::new(gpu(), &bvh, Precision::Fast).expect("the scene fits the device"));
    let engine = Engine::new(bvh, Precision::Fast);
    let mut hits = vec![FlatHit::MISS; case.rays.len()];
    let mut any = vec![2; case.rays.len()];
    engine.closest(&case.rays, &mut hits);
    engine.any(&case.rays, &mut any);
    let verdicts = oracle_batch(&oracle, &case.rays, &hits, &any);
    verdicts.iter().for_each(|verdict| tally.see("cpu", verdict));

    let Some(device) = device else { return };
    tally.on_device += case.rays.len();
    device.closest(&case.rays, &mut hits).expect("the device answers");
    device.any(&case.rays, &mut any).expect("the device answers");
    let verdicts = oracle_batch(&oracle, &case.rays, &hits, &any);
    verdicts.iter().for_each(|verdict| tally.see("device", verdict));
}

fn oracle_batch(oracle: &Oracle, rays: &[Ray], hits: &[FlatHit], any: &[u8]) -> Vec<Verdict> {
    let asked = rays.iter().zip(hits).zip(any);
    asked.flat_map(|((ray, hit), any)| [judge_closest(oracle, ray, hit), judge_any(oracle, ray, *any)]).collect()
}

#[test]
fn fast_keeps_its_promise_over_all_families() {
    println!("seed {SEED}");
    let (mut broken, mut asked) = (Vec::new(), 0);
    for family in families::all() {
        let mut tally = Tally::default();
        for case in family.cases(SEED, RAYS_PER_FAMILY) {
            judge(&case, &mut tally);
        }
        println!(
            "family {:>2} {:<26} {:>6} on the device; {:>6} as exact, {:>5} within the promise, {} beyond; t up to {} ULP, {:.3} of the promise",
            family.number,
            family.name,
            tally.on_device,
            tally.exact,
            tally.within,
            tally.wrong.len(),
            tally.ulp,
            tally.share
        );
        asked += tally.on_device;
        broken.extend(tally.wrong.into_iter().take(1).map(|case| format!("family {}:\n{case}", family.number)));
    }
    assert!(asked > 40 * RAYS_PER_FAMILY, "the device was asked for {asked} rays");
    assert!(broken.is_empty(), "{} families beyond the promise\n{}", broken.len(), broken.join("\n"));
}
