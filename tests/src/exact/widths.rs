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

fn compare(rays: &[Ray], bvh: &Bvh, cpu: &Cpu, tallies: &mut [Tally; 4]) {
    let mut right = vec![FlatHit::MISS; rays.len()];
    let mut counts = vec![0; rays.len()];
    cpu.closest(rays, &mut right);
    cpu.count(rays, &mut counts);
    for ((first, second), tally) in NUMBERS.into_iter().zip(tallies) {
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
    assert!(gpu().second_stage().expect("measured").is_some(), "this device runs the precision exact");
    let mut tallies = [Tally::default(); 4];
    for family in families::all() {
        for case in family.cases(5, rays(600, 10_000)) {
            let bvh = Bvh::new(&case.scene, Scaling::of(Precision::Exact)).expect("small");
            if bvh.plain {
                let cpu = Cpu::new(bvh.clone(), Precision::Exact);
                compare(&case.rays, &bvh, &cpu, &mut tallies);
            }
        }
    }
    for ((first, second), tally) in NUMBERS.into_iter().zip(tallies) {
        println!("{first:?}, {second:?}: {tally:?}, 0 differ");
        // Not all is left to the CPU: the device's own answers were compared.
        assert!(tally.left < tally.rays / 2, "{tally:?}");
    }
}
