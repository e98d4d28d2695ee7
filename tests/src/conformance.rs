//! Kernel against twin, in every bit, over every family of hard cases.

use rayproof::scene::bvh::{Bvh, Tier};
use rayproof::scene::{Hit, Ray, Scene};
use rayproof_cpu::Engine as Twin;
use rayproof_gpu::{Engine as Kernel, Gpu};
use rayproof_oracle::families::{self, Case};
use rayproof_oracle::judge::{compare_bits, ulp_distance};

use crate::device::{gpu, gpu_with_small_bindings};

const SEED: u64 = 20_261_123;
const RAYS_PER_FAMILY: usize = 20_000;
const TIERS: [Tier; 2] = [Tier::Classic, Tier::Fast];

/// Rays compared and hits among them.
#[derive(Default)]
struct Tally {
    rays: usize,
    hits: usize,
}

/// A scene in both engines.
struct Pair {
    kernel: Kernel,
    twin: Twin,
}

impl Pair {
    fn new(gpu: std::sync::Arc<Gpu>, scene: &Scene, tier: Tier) -> Self {
        let bvh = Bvh::new(scene, tier.scaling()).expect("small");
        let kernel = Kernel::new(gpu, &bvh, tier).expect("the scene fits the device");
        Self { kernel, twin: Twin::new(bvh, tier) }
    }

    /// Compares both queries of both engines; panics where a bit differs.
    fn compare(&self, what: &str, rays: &[Ray], tally: &mut Tally) {
        let mut device = vec![Hit::MISS; rays.len()];
        let mut twin = device.clone();
        self.kernel.closest(rays, &mut device).expect("the device answers");
        self.twin.closest(rays, &mut twin);
        let closest = compare_bits(&device, &twin);
        assert!(closest.agrees(0), "{what}: kernel and twin differ\n{closest}");
        let mut device_any = vec![2; rays.len()];
        let mut twin_any = vec![3; rays.len()];
        self.kernel.any(rays, &mut device_any).expect("the device answers");
        self.twin.any(rays, &mut twin_any);
        for (i, ray) in rays.iter().enumerate() {
            assert_eq!(device_any[i], twin_any[i], "{what}: any hit of ray {i}, {ray:?}");
            assert_eq!(device_any[i], u8::from(device[i].is_hit()), "{what}: any against closest of ray {i}, {ray:?}");
        }
        tally.rays += rays.len();
        tally.hits += device.iter().filter(|hit| hit.is_hit()).count();
    }
}

#[test]
fn the_device_is_ieee_through_spirv_and_not_through_wgsl() {
    use rayproof_gpu::{Fingerprint, Route};
    let gpu = gpu();
    let exact = Fingerprint::measure(&gpu, Route::ExactSpirv).expect("measured");
    println!("{exact}");
    assert!(exact.is_ieee() && exact.keeps_errors(), "{exact}");
    let plain = Fingerprint::measure(&gpu, Route::PlainWgsl).expect("measured");
    println!("{plain}");
    if gpu.name().contains("llvmpipe") {
        // What the route is for: if this turns green, drivers have changed and the route can go.
        assert!(!plain.is_ieee() && !plain.keeps_errors(), "{plain}");
    }
}

#[test]
fn kernels_equal_their_twins_over_all_families() {
    println!("seed {SEED}");
    let mut total = Tally::default();
    for family in families::all() {
        let mut tally = Tally::default();
        let cases = family.cases(SEED, RAYS_PER_FAMILY);
        for (i, Case { scene, rays }) in cases.iter().enumerate() {
            for tier in TIERS {
                let what = format!("family {} ({}), case {i}, {tier:?}", family.number, family.name);
                Pair::new(gpu(), scene, tier).compare(&what, rays, &mut tally);
            }
        }
        println!(
            "family {:>2} {:<48} {:>7} rays, {:>7} hits, 0 differ",
            family.number, family.name, tally.rays, tally.hits
        );
        assert!(tally.hits > 0, "family {} hits nothing: nothing was compared", family.number);
        total.rays += tally.rays;
        total.hits += tally.hits;
    }
    println!("in all {} rays, {} hits, closest and any, 0 bits differ", total.rays, total.hits);
}

#[test]
fn batches_of_every_size_come_back_whole() {
    for &size in families::BATCH_SIZES {
        let Case { scene, rays } = families::batch(size);
        let pair = Pair::new(gpu(), &scene, Tier::Fast);
        let mut tally = Tally::default();
        pair.compare(&format!("{size} rays"), &rays, &mut tally);
        let mut hits = vec![Hit::MISS; size];
        pair.kernel.closest(&rays, &mut hits).expect("the device answers");
        for (i, hit) in hits.iter().enumerate() {
            let known = families::batch_answer(i);
            // Neighbouring rays' answers lie thousands of ULP apart; four roundings lead to t = c / q.
            let near = hit.primitive == known.primitive && ulp_distance(hit.t, known.t) <= 4;
            assert!(near, "ray {i} of {size}: {hit:?}, not {known:?}");
        }
        println!("{size} rays, {} hits, each the known answer to 4 ULP", tally.hits);
    }
}

/// Scenes that take several bindings of one list, and batches cut by a small binding, give the same bits.
#[test]
fn lists_over_several_bindings_give_the_same_bits() {
    for bytes in [1 << 14, 1 << 16] {
        let gpu = gpu_with_small_bindings(bytes);
        for number in [1, 16, 21, 41] {
            let family = &families::all()[number - 1];
            let mut tally = Tally::default();
            for case in family.cases(SEED, 4000) {
                Pair::new(gpu.clone(), &case.scene, Tier::Fast).compare(family.name, &case.rays, &mut tally);
            }
        }
        let scene = crate::scenes::mixed(1200, 700);
        let rays = crate::scenes::rays_at(&scene, 30_000);
        let mut tally = Tally::default();
        Pair::new(gpu.clone(), &scene, Tier::Fast).compare("a mixed scene", &rays, &mut tally);
        println!("bindings of {bytes} bytes: {} rays, {} hits, 0 differ", tally.rays, tally.hits);
        assert!(tally.hits > 5000);
    }
}

#[test]
fn every_kind_of_scene_has_its_kernel() {
    for (triangles, spheres) in [(0, 0), (1, 0), (0, 1), (1, 1), (3000, 0), (0, 3000), (2000, 2000)] {
        let scene = crate::scenes::mixed(triangles, spheres);
        let rays = crate::scenes::rays_at(&scene, 20_000);
        for tier in TIERS {
            let mut tally = Tally::default();
            let what = format!("{triangles} triangles, {spheres} spheres, {tier:?}");
            Pair::new(gpu(), &scene, tier).compare(&what, &rays, &mut tally);
            println!("{what}: {} rays, {} hits, 0 differ", tally.rays, tally.hits);
            assert!(tally.hits > 0 || triangles + spheres < 3, "{what}");
        }
    }
}
