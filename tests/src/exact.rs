//! The tier `exact` against exact arithmetic, family by family: the same primitive, every number correctly rounded, every
//! crossing counted.

use rayproof::scene::bvh::{Bvh, Tier};
use rayproof::scene::{Hit, Ray, Undecided};
use rayproof_cpu::Engine;
use rayproof_oracle::families::{self, Case};
use rayproof_oracle::{ExactHit, Oracle};

const SEED: u64 = 11;

/// Rays a family: 100,000 where asked for, in an environment variable, and fewer in a run of all tests.
fn rays_per_family() -> usize {
    std::env::var("RAYPROOF_RAYS_PER_FAMILY").ok().and_then(|text| text.parse().ok()).unwrap_or(2_000)
}

/// What came of a family.
#[derive(Default)]
struct Tally {
    rays: usize,
    hits: usize,
    crossings: u64,
    wrong: Vec<String>,
    undecided: Undecided,
}

fn compare(case: &Case, tally: &mut Tally) {
    let oracle = Oracle::new(&case.scene);
    let engine = Engine::new(Bvh::new(&case.scene, Tier::Exact.scaling()).expect("small"), Tier::Exact);
    let mut hits = vec![Hit::MISS; case.rays.len()];
    let mut any = vec![2; case.rays.len()];
    let mut counts = vec![u32::MAX; case.rays.len()];
    tally.undecided += engine.closest(&case.rays, &mut hits);
    engine.any(&case.rays, &mut any);
    engine.count(&case.rays, &mut counts);
    let exact = oracle.batch(&case.rays, |oracle: &Oracle, ray: &Ray| (oracle.closest(ray), oracle.count(ray)));
    for (i, (closest, count)) in exact.into_iter().enumerate() {
        let right = closest.as_ref().map_or(Hit::MISS, ExactHit::to_hit);
        let (hit, any, counted, ray) = (hits[i], any[i], counts[i], &case.rays[i]);
        if !hit.same_bits(&right) || any != u8::from(right.is_hit()) || counted != count {
            tally.wrong.push(format!("{ray:?}:\n  {hit:?}, any {any}, count {counted}\n  {right:?}, count {count}"));
        }
        tally.hits += usize::from(right.is_hit());
        tally.crossings += u64::from(count);
    }
    tally.rays += case.rays.len();
}

#[test]
fn exact_is_exact_over_all_families() {
    println!("seed {SEED}");
    let mut broken = Vec::new();
    for family in families::all() {
        let mut tally = Tally::default();
        for case in family.cases(SEED, rays_per_family()) {
            compare(&case, &mut tally);
        }
        let Undecided { first_tier, after_refine, .. } = tally.undecided;
        println!(
            "family {:>2} {:<26} {:>7} rays, {:>7} hits, {:>8} crossings, {} wrong; {first_tier} open, {after_refine} resolved",
            family.number,
            family.name,
            tally.rays,
            tally.hits,
            tally.crossings,
            tally.wrong.len(),
        );
        let wrong = tally.wrong.len();
        broken.extend(tally.wrong.into_iter().take(1).map(|case| format!("family {}: {wrong}\n{case}", family.number)));
    }
    assert!(broken.is_empty(), "{} families are not exact\n{}", broken.len(), broken.join("\n"));
}
