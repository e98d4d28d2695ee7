//! What the precision `exact` promises, at its word.

mod families;
mod leaks;
mod spheres;
mod widths;
mod zeros;

use rayproof::Precision;
use rayproof::scene::{FlatHit, Ray, Scene, Undecided};
use rayproof_cpu::{Engine as Cpu, Exact as Own};
use rayproof_gpu::Engine as Device;
use rayproof_oracle::{ExactHit, Oracle};
use rayproof_tree::{Bvh, Scaling};

use crate::device::gpu;

/// How many rays: `few` in a run of all tests, and `all` where `RAYPROOF_THOROUGH` is set, which takes minutes.
pub(crate) fn rays(few: usize, all: usize) -> usize {
    if std::env::var_os("RAYPROOF_THOROUGH").is_some() { all } else { few }
}

/// A scene in all engines.
pub(crate) struct Engines {
    /// The kernels' twin, which gives devices their last answers.
    pub(crate) cpu: Cpu,
    /// The CPU's own walk: one ray at a time, several in turns, and with the instructions that every processor has.
    own: [Own; 3],
    /// None where the scene is not one for which the precision runs on a device.
    device: Option<Device>,
}

/// Every answer to a ray.
pub(crate) struct Answers {
    pub(crate) hits: Vec<FlatHit>,
    pub(crate) any: Vec<u8>,
    pub(crate) counts: Vec<u32>,
    /// On the way to the closest hits.
    pub(crate) undecided: Undecided,
}

impl Answers {
    fn none(rays: &[Ray]) -> Self {
        let n = rays.len();
        let (hits, any, counts) = (vec![FlatHit::MISS; n], vec![9; n], vec![u32::MAX; n]);
        Self { hits, any, counts, undecided: Undecided::default() }
    }
}

/// The exact answers to a ray.
pub(crate) struct Truth {
    pub(crate) hit: FlatHit,
    pub(crate) count: u32,
}

/// The exact answers to each ray.
pub(crate) fn truth(scene: &Scene, rays: &[Ray]) -> Vec<Truth> {
    Oracle::new(scene).batch(rays, |oracle: &Oracle, ray: &Ray| Truth {
        hit: oracle.closest(ray).as_ref().map_or(FlatHit::MISS, ExactHit::to_hit),
        count: oracle.count(ray),
    })
}

impl Engines {
    pub(crate) fn new(scene: &Scene) -> Self {
        let bvh = Bvh::new(scene, Scaling::of(Precision::Exact)).expect("small");
        let device = bvh.plain.then(|| Device::new(gpu(), &bvh, Precision::Exact).expect("the scene fits the device"));
        let own = Own::new(scene).expect("small");
        let plain = own.clone().with_plain_instructions().with_turns(true);
        let own = [own.clone().with_turns(false), own.with_turns(true), plain];
        Self { cpu: Cpu::new(bvh, Precision::Exact), own, device }
    }

    /// The twin's answers, which are those of the CPU's own walk in every bit.
    pub(crate) fn on_cpu(&self, rays: &[Ray]) -> Answers {
        let mut answers = Answers::none(rays);
        answers.undecided = self.cpu.closest(rays, &mut answers.hits);
        self.cpu.any(rays, &mut answers.any);
        self.cpu.count(rays, &mut answers.counts);
        for (own, what) in self.own.iter().zip(["one at a time", "in turns", "in turns, plain instructions"]) {
            let mut found = Answers::none(rays);
            own.closest(rays, &mut found.hits);
            own.any(rays, &mut found.any);
            own.count(rays, &mut found.counts);
            for (i, ray) in rays.iter().enumerate() {
                assert!(
                    found.hits[i].same_bits(&answers.hits[i]),
                    "{what}: {ray:?}: {:?}, not {:?}",
                    found.hits[i],
                    answers.hits[i]
                );
                assert_eq!((found.any[i], found.counts[i]), (answers.any[i], answers.counts[i]), "{what}: {ray:?}");
            }
        }
        answers
    }

    /// The device's answers, and the CPU's for the rays that it left open.
    pub(crate) fn on_device(&self, rays: &[Ray]) -> Option<Answers> {
        let device = self.device.as_ref()?;
        let mut answers = Answers::none(rays);
        let open = device.closest(rays, &mut answers.hits).expect("the device answers");
        resolve(&open.rays, rays, &mut answers.hits, FlatHit::MISS, |rays, hits| self.cpu.closest(rays, hits));
        let left = open.rays.len() as u64;
        answers.undecided = Undecided { first_stage: open.after_first, after_refine: left, resolved_on_cpu: left };
        let open = device.any(rays, &mut answers.any).expect("the device answers");
        resolve(&open.rays, rays, &mut answers.any, 9, |rays, any| self.cpu.any(rays, any));
        let open = device.count(rays, &mut answers.counts).expect("the device answers");
        resolve(&open.rays, rays, &mut answers.counts, u32::MAX, |rays, counts| self.cpu.count(rays, counts));
        Some(answers)
    }
}

fn resolve<A: Copy>(
    open: &[usize],
    rays: &[Ray],
    answers: &mut [A],
    none: A,
    ask: impl Fn(&[Ray], &mut [A]) -> Undecided,
) {
    let left: Vec<Ray> = open.iter().map(|&i| rays[i]).collect();
    let mut found = vec![none; left.len()];
    ask(&left, &mut found);
    open.iter().zip(found).for_each(|(&i, found)| answers[i] = found);
}
