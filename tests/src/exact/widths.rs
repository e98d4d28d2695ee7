//! Numbers that this device's measurement does not choose, but another's may: the same bits in the end.

use rayproof::Precision;
use rayproof::scene::{FlatHit, Ray};
use rayproof_cpu::Engine as Cpu;
use rayproof_gpu::{Engine as Device, SecondStage, Width};
use rayproof_oracle::families;
use rayproof_tree::{Bvh, Scaling};

use super::rays;
use crate::device::gpu;

/// A first pass by the wider rules, and second passes in each width, with and without a rest.
const NUMBERS: [(Width, SecondStage); 4] = [
    (Width::SingleByRule, SecondStage { width: Width::Double, rest: None }),
    (Width::Single, SecondStage { width: Width::PairOfF32, rest: None }),
    (Width::Single, SecondStage { width: Width::PairOfF32, rest: Some(Width::PairOfF64) }),
    (Width::SingleByRule, SecondStage { width: Width::PairOfF64, rest: None }),
];

/// What came of one choice.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    rays: usize,
    open: u64,
    left: usize,
}

/// Those that this device has and that keep their promise on it; the others are told.
fn kept() -> Vec<(Width, SecondStage)> {
    let trials = gpu().trials().expect("the device answers");
    let keeps = |width: Width| {
        let kept = trials.keep(width);
        if !kept {
            println!("left out: {width}, {}", trials.why_not(width).expect("a reason"));
        }
        kept
    };
    NUMBERS.into_iter().filter(|(_, second)| keeps(second.width) && second.rest.is_none_or(keeps)).collect()
}

fn compare(rays: &[Ray], bvh: &Bvh, cpu: &Cpu, numbers: &[(Width, SecondStage)], tallies: &mut [Tally]) {
    let mut right = vec![FlatHit::MISS; rays.len()];
    let mut counts = vec![0; rays.len()];
    cpu.closest(rays, &mut right);
    cpu.count(rays, &mut counts);
    for (&(first, second), tally) in numbers.iter().zip(tallies) {
        let device = Device::with_numbers(gpu(), bvh, first, second).expect("the scene fits the device");
        let mut hits = vec![FlatHit::MISS; rays.len()];
        let open = device.closest(rays, &mut hits).expect("the device answers");
        open.rays.iter().for_each(|&i| hits[i] = right[i]);
        let mut counted = vec![0; rays.len()];
        let left = device.count(rays, &mut counted).expect("the device answers").rays;
        left.iter().for_each(|&i| counted[i] = counts[i]);
        for (i, ray) in rays.iter().enumerate() {
            assert!(hits[i].same_bits(&right[i]), "{first:?}, {second:?}: {ray:?}\n{:?}\n{:?}", hits[i], right[i]);
            assert_eq!(counted[i], counts[i], "{first:?}, {second:?}: {ray:?}");
        }
        tally.rays += rays.len();
        tally.open += open.after_first;
        tally.left += open.rays.len();
    }
}

#[test]
fn every_width_gives_the_same_bits() {
    let numbers = kept();
    assert!(!numbers.is_empty(), "this device does not run the precision exact");
    let mut tallies = vec![Tally::default(); numbers.len()];
    for family in families::all() {
        for case in family.cases(5, rays(600, 10_000)) {
            let bvh = Bvh::new(&case.scene, Scaling::of(Precision::Exact)).expect("small");
            if bvh.plain {
                let cpu = Cpu::new(bvh.clone(), Precision::Exact);
                compare(&case.rays, &bvh, &cpu, &numbers, &mut tallies);
            }
        }
    }
    for ((first, second), tally) in numbers.into_iter().zip(tallies) {
        println!("{first:?}, {second:?}: {tally:?}, 0 differ");
        // Not all is left to the CPU: the device's own answers were compared.
        assert!(tally.left < tally.rays / 2, "{tally:?}");
    }
}
