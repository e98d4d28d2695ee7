//! The calculation that the oracle lays out, against the engines that it stands for: the same bits.

use rayproof::Precision;
use rayproof::scene::{FlatHit, Geometry, Mesh, Primitive, Ray, Scene, Triangle};
use rayproof_cpu::Engine;
use rayproof_oracle::Oracle;
use rayproof_oracle::families::{self, Family};
use rayproof_oracle::worked::{COLUMNS, Conclusion, EXACT, Value, work};
use rayproof_tree::{Bvh, Scaling};

const SEED: u64 = 20_261_125;
const RAYS_PER_FAMILY: usize = 1_000;

/// The precisions that are laid out and that an engine computes in.
const COMPUTED: &[Precision] = COLUMNS.split_at(EXACT).0;

/// The families, and why what is laid out, on unscaled numbers, may differ there from a precision that scales.
const OUT_OF_RANGE: [(u32, &str); 11] = [
    (7, "radii of 6e17: d.d r^2 overflows"),
    (11, "d.d underflows"),
    (12, "d.d and b^2 overflow"),
    (13, "d.d underflows"),
    (14, "o.o overflows"),
    (15, "r^2 underflows"),
    (27, "products of three lengths under- or overflow"),
    (34, "u and v of the smallest subnormal, which underflow times det"),
    (37, "the ends of f32 in every slot"),
    (38, "boxes at 1e30: products of three lengths overflow"),
    (41, "recorded rays with the smallest subnormal in the origin or the direction"),
];

/// What was compared of a family.
#[derive(Default)]
struct Tally {
    answers: usize,
    hits: usize,
    /// Answers that differ, precision by precision.
    differ: [usize; EXACT],
    /// False hits that the tree spared a ray.
    spared: usize,
    /// The first difference outside of the families and precisions that may differ.
    wrong: Option<String>,
}

impl Tally {
    fn of(family: &Family) -> Self {
        let mut tally = Self::default();
        let out_of_range = OUT_OF_RANGE.iter().any(|&(number, _)| number == family.number);
        for case in family.cases(SEED, RAYS_PER_FAMILY) {
            let oracle = Oracle::new(&case.scene);
            for (i, ray) in case.rays.iter().enumerate().filter(|_| !case.scene.is_empty()) {
                let nearest = oracle.closest(ray).map(|hit| hit.primitive as usize);
                let primitive = case.scene.primitive(nearest.unwrap_or(i % case.scene.len()));
                tally.compare(ray, &primitive, out_of_range);
            }
        }
        tally
    }

    fn compare(&mut self, ray: &Ray, primitive: &Primitive, out_of_range: bool) {
        let (scene, worked) = (alone(primitive), work(ray, primitive));
        for (i, &precision) in COMPUTED.iter().enumerate() {
            let Some(laid_out) = as_hit(&worked.answers[i]) else { continue };
            let engine = Engine::new(Bvh::new(&scene, Scaling::of(precision)).expect("small"), precision);
            let in_tree = closest(&engine, ray);
            let hit = closest(&engine.without_tree(), ray);
            if !hit.same_bits(&in_tree) {
                assert_eq!(in_tree, FlatHit::MISS, "a tree can only spare a hit: {hit:?} of {ray:?} and {primitive:?}");
                self.spared += 1;
            }
            self.answers += 1;
            self.hits += usize::from(hit.is_hit());
            if !hit.same_bits(&laid_out) {
                self.differ[i] += 1;
                if !(out_of_range && matches!(precision, Precision::Fast | Precision::Double)) {
                    let what =
                        || format!("{precision:?}: {hit:?}, laid out {laid_out:?}, of {ray:?} and {primitive:?}");
                    self.wrong.get_or_insert_with(what);
                }
            }
        }
    }
}

/// A scene of the primitive alone.
fn alone(primitive: &Primitive) -> Scene {
    Scene::new(vec![match *primitive {
        Primitive::Sphere(sphere) => Geometry::Spheres(vec![sphere]),
        Primitive::Triangle(Triangle { a, b, c }) => {
            Geometry::Mesh(Mesh { vertices: vec![a, b, c], triangles: vec![[0, 1, 2]] })
        }
    }])
    .expect("a valid scene")
}

/// The answer as an engine gives it; `None` where the method has none.
fn as_hit(answer: &Conclusion) -> Option<FlatHit> {
    match *answer {
        Conclusion::Absent => None,
        Conclusion::Miss(_) => Some(FlatHit::MISS),
        Conclusion::Hit { t: Value::F32(t), u: Value::F32(u), v: Value::F32(v) } => {
            Some(FlatHit { t, u, v, primitive: 0 })
        }
        Conclusion::Hit { .. } => panic!("an engine answers in f32, not {answer:?}"),
    }
}

fn closest(engine: &Engine, ray: &Ray) -> FlatHit {
    let mut hits = [FlatHit::MISS];
    engine.closest(&[*ray], &mut hits);
    hits[0]
}

#[test]
fn what_is_laid_out_is_what_engines_do() {
    println!("seed {SEED}");
    let (mut wrong, mut same, mut idle) = (Vec::new(), 0, Vec::new());
    for family in families::all() {
        let Tally { answers, hits, differ, spared, wrong: first } = Tally::of(family);
        let reason = OUT_OF_RANGE.iter().find(|&&(number, _)| number == family.number).map_or("", |&(_, why)| why);
        println!(
            "family {:>2} {:<26} {answers:>5} answers, {hits:>5} hits, {differ:?} differ, {spared:>3} spared  {reason}",
            family.number, family.name
        );
        wrong.extend(first.map(|what| format!("family {}: {what}", family.number)));
        if reason.is_empty() {
            assert!(hits > answers / 10, "family {} hits too little to compare", family.number);
            same += hits;
        } else if differ == [0; 4] {
            idle.push(family.number);
        }
    }
    println!("{same} hits without a different bit in the families that are in range");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(idle.is_empty(), "families that need no exception: {idle:?}");
    assert!(same > 60_000, "{same} hits compared");
}
