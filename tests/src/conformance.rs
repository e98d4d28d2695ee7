//! Kernel against twin, in every bit, over every family of hard cases.

use rayproof::Precision;
use rayproof::scene::{FlatHit, Ray, Scene};
use rayproof_cpu::Engine as Twin;
use rayproof_gpu::{Engine as Kernel, Error, Gpu, Route, Width};
use rayproof_oracle::families::{self, Case};
use rayproof_oracle::judge::{compare_bits, ulp_distance};
use rayproof_tree::{Bvh, Scaling};

use crate::device::{gpu, gpu_with_small_bindings};

const SEED: u64 = 20_261_123;
const RAYS_PER_FAMILY: usize = 20_000;

/// The precisions that promise the CPU's bits on the device: all where it is IEEE, else `exact`.
pub(crate) fn precisions() -> impl Iterator<Item = Precision> {
    let is_ieee = gpu().fingerprint().is_ieee();
    Precision::ALL.into_iter().filter(move |precision| is_ieee || *precision == Precision::Exact)
}

/// One of them, `fast` if it is.
fn one_precision() -> Precision {
    precisions().find(|precision| *precision == Precision::Fast).unwrap_or(Precision::Exact)
}

/// Rays compared, hits among them, and rays that the device left to exact arithmetic.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) rays: usize,
    pub(crate) hits: usize,
    left: usize,
}

/// A scene in both engines.
pub(crate) struct Pair {
    /// None where the device says that the precision does not run there with the scene.
    kernel: Option<Kernel>,
    twin: Twin,
    precision: Precision,
    is_ieee: bool,
}

impl Pair {
    pub(crate) fn new(gpu: std::sync::Arc<Gpu>, scene: &Scene, precision: Precision) -> Self {
        let bvh = Bvh::new(scene, Scaling::of(precision)).expect("small");
        let is_ieee = gpu.fingerprint().is_ieee();
        let refusal = gpu.refuses(precision, &bvh).expect("asked");
        let kernel = refusal.is_none().then(|| Kernel::new(gpu, &bvh, precision).expect("the scene fits the device"));
        Self { kernel, twin: Twin::new(bvh, precision), precision, is_ieee }
    }

    /// Compares all queries of both engines; panics where a bit differs. What the device leaves open is the twin's to answer, and
    /// its first stage leaves open what the twin's does; but on a device that is not IEEE its bounds are wider.
    pub(crate) fn compare(&self, what: &str, rays: &[Ray], tally: &mut Tally) {
        let Some(kernel) = &self.kernel else { return };
        let mut device = vec![FlatHit::MISS; rays.len()];
        let mut twin = device.clone();
        let open = kernel.closest(rays, &mut device).expect("the device answers");
        let undecided = self.twin.closest(rays, &mut twin);
        if self.is_ieee {
            assert_eq!(open.after_first, undecided.first_stage, "{what}: rays open after the first stage, closest");
        }
        open.rays.iter().for_each(|&i| device[i] = twin[i]);
        let closest = compare_bits(&device, &twin);
        assert!(closest.agrees(0), "{what}: kernel and twin differ\n{closest}");
        tally.left += open.rays.len();

        let mut device_any = vec![2; rays.len()];
        let mut twin_any = vec![3; rays.len()];
        let open = kernel.any(rays, &mut device_any).expect("the device answers");
        let undecided = self.twin.any(rays, &mut twin_any);
        if self.is_ieee {
            assert_eq!(open.after_first, undecided.first_stage, "{what}: rays open after the first stage, any");
        }
        open.rays.iter().for_each(|&i| device_any[i] = twin_any[i]);
        for (i, ray) in rays.iter().enumerate() {
            assert_eq!(device_any[i], twin_any[i], "{what}: any hit of ray {i}, {ray:?}");
            assert_eq!(device_any[i], u8::from(device[i].is_hit()), "{what}: any against closest of ray {i}, {ray:?}");
        }
        if self.precision == Precision::Exact {
            self.compare_counts(kernel, what, rays);
        }
        tally.rays += rays.len();
        tally.hits += device.iter().filter(|hit| hit.is_hit()).count();
    }

    fn compare_counts(&self, kernel: &Kernel, what: &str, rays: &[Ray]) {
        let mut device = vec![u32::MAX; rays.len()];
        let mut twin = vec![u32::MAX; rays.len()];
        let open = kernel.count(rays, &mut device).expect("the device answers");
        let undecided = self.twin.count(rays, &mut twin);
        if self.is_ieee {
            assert_eq!(open.after_first, undecided.first_stage, "{what}: rays open after the first stage, count");
        }
        open.rays.iter().for_each(|&i| device[i] = twin[i]);
        for (i, ray) in rays.iter().enumerate() {
            assert_eq!(device[i], twin[i], "{what}: crossings of ray {i}, {ray:?}");
        }
    }
}

#[test]
fn arithmetic_is_kept_through_spirv_and_not_through_wgsl() {
    let gpu = gpu();
    let exact = gpu.fingerprint_on(Route::ExactSpirv).expect("measured");
    println!("{exact}");
    // Sums, products and what they lose are what `exact` stands on; roots and comparisons may be off (NVIDIA's are).
    assert!(exact.keeps_errors() && exact.sum_wrong + exact.product_wrong + exact.contracted == 0, "{exact}");
    let plain = gpu.fingerprint_on(Route::PlainWgsl).expect("measured");
    println!("{plain}");
    if gpu.name().contains("llvmpipe") {
        let trials = gpu.trials().expect("tried");
        // Mesa 25 folds f64(f32(x)) to x: shaders/exact/number/narrow.wgsl is what f64 stands on there.
        assert!(trials.keep(Width::Double) && trials.keep(Width::PairOfF64), "{trials:?}");
        // What the route is for: if this turns green, drivers have changed and the route can go.
        assert!(exact.is_ieee() && !plain.is_ieee() && !plain.keeps_errors(), "{plain}");
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
            for precision in precisions() {
                let what = format!("family {} ({}), case {i}, {precision:?}", family.number, family.name);
                Pair::new(gpu(), scene, precision).compare(&what, rays, &mut tally);
            }
        }
        println!(
            "family {:>2} {:<26} {:>7} rays, {:>7} hits, 0 differ; {:>6} left to the CPU",
            family.number, family.name, tally.rays, tally.hits, tally.left
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
        let pair = Pair::new(gpu(), &scene, one_precision());
        let mut tally = Tally::default();
        pair.compare(&format!("{size} rays"), &rays, &mut tally);
        let mut hits = vec![FlatHit::MISS; size];
        pair.kernel.as_ref().expect("plain").closest(&rays, &mut hits).expect("the device answers");
        for (i, hit) in hits.iter().enumerate() {
            let known = families::batch_answer(i);
            // Neighbouring rays' answers lie thousands of ULP apart; four roundings lead to t = c / q of `fast`.
            let near = hit.primitive == known.primitive && ulp_distance(hit.t, known.t) <= 4;
            assert!(near, "ray {i} of {size}: {hit:?}, not {known:?}");
        }
        println!("{size} rays, {} hits, each the known answer to 4 ULP", tally.hits);
    }
}

/// Scenes that take several bindings of one list, and batches cut by a small binding, give the same bits. A kernel has as many
/// bindings as the device says (llvmpipe's a million, SwiftShader's ten): a scene that takes more is told.
#[test]
fn lists_over_several_bindings_give_the_same_bits() {
    let scenes =
        [("a mixed scene", crate::scenes::mixed(1200, 700)), ("a larger one", crate::scenes::mixed(3000, 2000))];
    let mut compared = Vec::new();
    for bytes in [1 << 14, 1 << 16] {
        let gpu = gpu_with_small_bindings(bytes);
        for number in [1, 16, 21, 41] {
            let family = &families::all()[number - 1];
            let cases = family.cases(SEED, 4000);
            for case in cases.iter().filter(|case| fits(&gpu, &case.scene)) {
                let mut tally = Tally::default();
                Pair::new(gpu.clone(), &case.scene, one_precision()).compare(family.name, &case.rays, &mut tally);
            }
        }
        for (what, scene) in scenes.iter().filter(|(_, scene)| fits(&gpu, scene)) {
            let rays = crate::scenes::rays_at(scene, 30_000);
            let mut tally = Tally::default();
            Pair::new(gpu.clone(), scene, one_precision()).compare(what, &rays, &mut tally);
            println!("{what}, bindings of {bytes} bytes: {} rays, {} hits, 0 differ", tally.rays, tally.hits);
            assert!(tally.hits > 5000);
            compared.push((*what, bytes));
        }
    }
    // The triangles of the larger one are 141 KiB: three bindings.
    assert!(compared.contains(&("a larger one", 1 << 16)), "no list of several bindings was compared: {compared:?}");
}

/// Whether the device has bindings enough for the scene; if not, says how many it would take.
fn fits(gpu: &std::sync::Arc<Gpu>, scene: &Scene) -> bool {
    let bvh = Bvh::new(scene, Scaling::of(one_precision())).expect("small");
    match Kernel::new(gpu.clone(), &bvh, one_precision()) {
        Err(Error::TooLarge { what }) => {
            println!("{what}");
            false
        }
        _ => true,
    }
}

#[test]
fn every_kind_of_scene_has_its_kernel() {
    for (triangles, spheres) in [(0, 0), (1, 0), (0, 1), (1, 1), (3000, 0), (0, 3000), (2000, 2000)] {
        let scene = crate::scenes::mixed(triangles, spheres);
        let rays = crate::scenes::rays_at(&scene, 20_000);
        for precision in precisions() {
            let mut tally = Tally::default();
            let what = format!("{triangles} triangles, {spheres} spheres, {precision:?}");
            Pair::new(gpu(), &scene, precision).compare(&what, &rays, &mut tally);
            println!("{what}: {} rays, {} hits, 0 differ", tally.rays, tally.hits);
            assert!(tally.hits > 0 || triangles + spheres < 3, "{what}");
        }
    }
}
