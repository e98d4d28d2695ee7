//! Damaged answers are caught, each for the right reason, and healthy ones at the margin are let through.

use glam::Vec3;
use rayproof_scene::{FlatHit, Geometry, Ray, Scene, Sphere, Triangle};

use super::{mesh, sphere_scene, triangle_scene};
use crate::{
    Oracle,
    judge::{Errors, Fault, Verdict, judge_any, judge_closest, judge_count},
};

/// Two triangles one behind the other, and a sphere behind both.
fn scene() -> Scene {
    let at = |z: f32| Triangle {
        a: Vec3::new(0.1, 0.2, z),
        b: Vec3::new(1.3, 0.1, z + 0.1),
        c: Vec3::new(0.2, 1.7, z - 0.2),
    };
    Scene::new(vec![
        mesh(&[at(1.0), at(-1.0)]),
        Geometry::Spheres(vec![Sphere { center: Vec3::new(0.4, 0.5, -9.0), radius: 2.0 }]),
    ])
    .expect("a valid scene")
}

fn ray() -> Ray {
    Ray::new(Vec3::new(0.5, 0.6, 5.0), Vec3::new(0.01, -0.02, -1.3))
}

fn fault(verdict: &Verdict) -> Fault {
    match verdict {
        Verdict::Disagrees(fault, _) => *fault,
        fine => panic!("not caught: {fine}"),
    }
}

fn errors(verdict: &Verdict) -> Errors {
    match verdict {
        Verdict::Exact(errors) => *errors,
        other => panic!("{other}"),
    }
}

#[test]
fn damaged_hits_on_a_triangle_are_caught() {
    let scene = scene();
    let (oracle, ray) = (Oracle::new(&scene), ray());
    let good = oracle.closest(&ray).unwrap().to_hit();
    assert_eq!(good.primitive, 0);
    assert!(judge_closest(&oracle, &ray, &good).is_nearest());
    let judge = |hit: FlatHit| judge_closest(&oracle, &ray, &hit);

    let off = judge(FlatHit { t: good.t.next_up(), ..good });
    assert_eq!((errors(&off).t, errors(&off).u, off.is_nearest()), (1, 0, false));
    let off = judge(FlatHit { u: good.u.next_up().next_up(), v: good.v.next_down(), ..good });
    assert_eq!((errors(&off).t, errors(&off).u, errors(&off).v, off.is_nearest()), (0, 2, 1, false));

    for wrong in [
        FlatHit { t: good.t * 1.001, ..good },
        FlatHit { t: good.t * 0.999, ..good },
        FlatHit { t: good.t * 1.000_01, ..good },
        FlatHit { t: f32::INFINITY, ..good },
        FlatHit { u: good.v, v: good.u, ..good },
        FlatHit { u: good.u * 1.001, ..good },
        FlatHit { v: 0.0, ..good },
    ] {
        assert!(matches!(fault(&judge(wrong)), Fault::WrongNumbers(off) if off > 1.0), "{wrong:?}");
    }
    for wrong in [
        FlatHit { t: f32::NAN, ..good },
        FlatHit { u: f32::NAN, ..good },
        FlatHit { v: f32::NAN, ..good },
        FlatHit { t: f32::NAN, ..FlatHit::MISS },
    ] {
        assert_eq!(fault(&judge(wrong)), Fault::NotANumber);
    }
    for wrong in [FlatHit { u: 0.75, v: 0.75, ..good }, FlatHit { u: -1.0e-30, ..good }, FlatHit { v: -0.1, ..good }] {
        assert_eq!(fault(&judge(wrong)), Fault::OutsidePrimitive);
    }
    assert_eq!(fault(&judge(FlatHit { t: -good.t, ..good })), Fault::OutOfRange);
    assert!(matches!(fault(&judge(FlatHit { primitive: 1, ..good })), Fault::FalseHit(_)));
    assert_eq!(fault(&judge(FlatHit { primitive: 2, ..good })), Fault::OutsidePrimitive);
    assert_eq!(fault(&judge(FlatHit { primitive: 3, ..good })), Fault::NoSuchPrimitive);
    assert_eq!(fault(&judge(FlatHit::MISS)), Fault::PassedOver { primitive: 0, t: good.t });
    assert_eq!(fault(&judge(FlatHit { u: 0.5, ..FlatHit::MISS })), Fault::MalformedMiss);
    assert_eq!(fault(&judge(FlatHit { t: 1.0, ..FlatHit::MISS })), Fault::MalformedMiss);

    // The true hits behind it are not the closest.
    for behind in &oracle.all(&ray)[1..] {
        assert_eq!(fault(&judge(behind.to_hit())), Fault::PassedOver { primitive: 0, t: good.t });
    }
}

#[test]
fn damaged_hits_on_a_sphere_are_caught() {
    let scene = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 2.0 }]);
    let (oracle, ray) = (Oracle::new(&scene), Ray::new(Vec3::new(0.3, 0.4, 7.0), Vec3::new(0.02, 0.01, -1.1)));
    let good = oracle.closest(&ray).unwrap().to_hit();
    let judge = |hit: FlatHit| judge_closest(&oracle, &ray, &hit);
    assert!(judge(good).is_nearest());
    assert_eq!(errors(&judge(FlatHit { t: good.t.next_down(), ..good })).t, 1);
    for factor in [1.001, 0.999, 1.000_01] {
        assert!(matches!(fault(&judge(FlatHit { t: good.t * factor, ..good })), Fault::WrongNumbers(_)));
    }
    assert_eq!(fault(&judge(FlatHit { u: 0.1, ..good })), Fault::OutsidePrimitive);
    assert_eq!(fault(&judge(FlatHit::MISS)), Fault::PassedOver { primitive: 0, t: good.t });
    // The far root is a hit, but not the closest.
    let far = oracle.all(&ray)[1].to_hit();
    assert_eq!(fault(&judge(far)), Fault::PassedOver { primitive: 0, t: good.t });
    // Outside by a hundredth of the radius.
    let past = Ray::new(Vec3::new(2.02, 0.0, 7.0), Vec3::NEG_Z);
    assert!(matches!(fault(&judge_closest(&oracle, &past, &FlatHit { t: 7.0, ..good })), Fault::FalseHit(_)));
}

#[test]
fn a_hit_where_there_is_none_is_caught() {
    let scene = scene();
    let (oracle, past) = (Oracle::new(&scene), Ray::new(Vec3::new(9.0, 9.0, 5.0), Vec3::NEG_Z));
    let claim = FlatHit { t: 4.0, u: 0.0, v: 0.0, primitive: 0 };
    assert_eq!(errors(&judge_closest(&oracle, &past, &FlatHit::MISS)), Errors::default());
    assert!(matches!(fault(&judge_closest(&oracle, &past, &claim)), Fault::FalseHit(_)));
    let short = Ray { t_max: 1.0, ..ray() };
    let good = oracle.closest(&ray()).unwrap().to_hit();
    assert_eq!(fault(&judge_closest(&oracle, &short, &good)), Fault::OutOfRange);
    let faulty = Ray { direction: Vec3::ZERO, ..past };
    assert_eq!(fault(&judge_closest(&oracle, &faulty, &claim)), Fault::OutOfRange);
}

#[test]
fn wrong_flags_and_counts_are_caught() {
    let scene = scene();
    let (oracle, ray) = (Oracle::new(&scene), ray());
    let past = Ray::new(Vec3::new(9.0, 9.0, 5.0), Vec3::NEG_Z);
    assert_eq!(errors(&judge_any(&oracle, &ray, 1)), Errors::default());
    assert_eq!(errors(&judge_any(&oracle, &past, 0)), Errors::default());
    assert!(matches!(fault(&judge_any(&oracle, &ray, 0)), Fault::PassedOver { primitive: 0, .. }));
    assert_eq!(fault(&judge_any(&oracle, &past, 1)), Fault::Unaccounted);
    assert_eq!(fault(&judge_any(&oracle, &ray, 2)), Fault::NotAFlag);
    assert_eq!(errors(&judge_count(&oracle, &ray, 4)), Errors::default());
    for wrong in [0, 3, 5] {
        assert_eq!(fault(&judge_count(&oracle, &ray, wrong)), Fault::Unaccounted);
    }
}

/// Copies of one triangle give the same bits, so the tie is not for rounding to decide.
#[test]
fn a_tie_given_to_the_higher_number_is_caught() {
    let one = Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y };
    let scene = triangle_scene(&[one, one]);
    let (oracle, ray) = (Oracle::new(&scene), Ray::new(Vec3::new(0.3, 0.3, 0.7), Vec3::new(0.01, 0.02, -0.9)));
    let good = oracle.closest(&ray).unwrap().to_hit();
    assert!(judge_closest(&oracle, &ray, &good).is_nearest());
    let wrong = judge_closest(&oracle, &ray, &FlatHit { primitive: 1, ..good });
    assert_eq!(fault(&wrong), Fault::PassedOver { primitive: 0, t: good.t });
}

/// A ray within rounding of an edge, of the silhouette, of an end of the range, of a tie: both answers pass.
#[test]
fn marginal_answers_are_forgiven() {
    let forgiven = |verdict: &Verdict| matches!(verdict, Verdict::WithinPromise(_));
    let unit = triangle_scene(&[Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y }]);
    let oracle = Oracle::new(&unit);
    let at = |x: f32| Ray::new(Vec3::new(x, 0.3, 1.0), Vec3::NEG_Z);
    let claim = FlatHit { t: 1.0, u: 0.0, v: 0.3, primitive: 0 };
    assert!(forgiven(&judge_closest(&oracle, &at(1.0e-9), &FlatHit::MISS)));
    assert!(forgiven(&judge_any(&oracle, &at(1.0e-9), 0)));
    assert!(forgiven(&judge_closest(&oracle, &at(-1.0e-9), &claim)));
    assert!(forgiven(&judge_any(&oracle, &at(-1.0e-9), 1)));
    assert!(forgiven(&judge_count(&oracle, &at(-1.0e-9), 1)));
    for (x, hit, flag) in [(1.0e-5, FlatHit::MISS, 0), (-1.0e-5, claim, 1)] {
        fault(&judge_closest(&oracle, &at(x), &hit));
        fault(&judge_any(&oracle, &at(x), flag));
        fault(&judge_count(&oracle, &at(x), u32::from(flag)));
    }
    let short = Ray { t_max: 1.0, ..at(0.25) };
    assert!(forgiven(&judge_closest(&oracle, &short, &FlatHit::MISS)));
    fault(&judge_closest(&oracle, &Ray { t_max: 1.001, ..short }, &FlatHit::MISS));

    let ball = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 1.0 }]);
    let oracle = Oracle::new(&ball);
    let at = |x: f32| Ray::new(Vec3::new(x, 0.0, 2.0), Vec3::NEG_Z);
    let claim = FlatHit { t: 2.0, u: 0.0, v: 0.0, primitive: 0 };
    let (inside, outside) = (1.0_f32.next_down(), 1.0_f32.next_up());
    assert!(forgiven(&judge_closest(&oracle, &at(inside), &FlatHit::MISS)));
    assert!(forgiven(&judge_closest(&oracle, &at(outside), &claim)));
    fault(&judge_closest(&oracle, &at(0.999_98), &FlatHit::MISS));
    fault(&judge_closest(&oracle, &at(1.000_02), &claim));

    // From the surface inwards the near root is t = 0, the end of the range: the far root of the same sphere passes.
    let ball = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 5.0 }]);
    let (oracle, inwards) = (Oracle::new(&ball), Ray::new(Vec3::new(3.0, 4.0, 0.0), Vec3::NEG_X));
    let roots: Vec<_> = oracle.all(&inwards).iter().map(crate::ExactHit::to_hit).collect();
    assert!(judge_closest(&oracle, &inwards, &roots[0]).is_nearest());
    assert!(forgiven(&judge_closest(&oracle, &inwards, &roots[1])));

    let pair = [1.0, 1.0_f32.next_up()].map(|z| Triangle {
        a: Vec3::Z * z,
        b: Vec3::X + Vec3::Z * z,
        c: Vec3::Y + Vec3::Z * z,
    });
    let pair = triangle_scene(&pair);
    let (oracle, down) = (Oracle::new(&pair), Ray::new(Vec3::new(0.25, 0.25, 9.0), Vec3::NEG_Z));
    let hits: Vec<_> = oracle.all(&down).iter().map(crate::ExactHit::to_hit).collect();
    assert_eq!((hits[0].primitive, hits[1].primitive), (1, 0));
    assert!(forgiven(&judge_closest(&oracle, &down, &hits[1])));
}

#[test]
fn a_verdict_reads_as_a_case_to_replay() {
    let scene = scene();
    let verdict = judge_closest(&Oracle::new(&scene), &ray(), &FlatHit::MISS).to_string();
    println!("{verdict}");
    for part in [
        "disagrees: a clear hit was passed over: primitive 0",
        "0x40a00000 5.0",
        "-1.3",
        "0x7f800000 inf",
        "(geometry 0, primitive 0)",
        "miss",
    ] {
        assert!(verdict.contains(part), "{part} in\n{verdict}");
    }
    let scene = sphere_scene(&[Sphere { center: Vec3::ZERO, radius: 1.0 }]);
    let verdict = judge_any(&Oracle::new(&scene), &ray(), 1).to_string();
    assert!(verdict.contains("any 0") && verdict.contains("any 1") || verdict.starts_with("exact"), "{verdict}");
}
