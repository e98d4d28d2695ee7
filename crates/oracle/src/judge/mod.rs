//! The one place where an answer is compared with the truth.
//!
//! # What is promised
//!
//! The precision `exact` promises the exact answer with its numbers rounded to the nearest: [`Verdict::is_nearest`]. The precision
//! `fast` computes in single precision, and promises what that allows. An answer is
//!
//! * [`Exact`](Verdict::Exact) when it has the exact hit's primitive and `t`, `u`, `v` within the error bounds of the
//!   method, which grow with the condition of the problem;
//! * [`WithinPromise`](Verdict::WithinPromise) when it is another, and rounding explains it: the claimed hit exists to
//!   within the bounds, and every exact hit before it is one that single precision may miss (on an edge, at the
//!   silhouette, at an end of the range) or take for a later one;
//! * [`Disagrees`](Verdict::Disagrees) when it is wrong.
//!
//! The modules `triangle` and `sphere` derive the bounds by counting roundings. They are worst cases for the method of
//! the precision `fast` under IEEE rounding. The precision `classic` promises nothing, and is judged by the same measure.

mod bits;
mod judged_ray;
mod promise;
mod sphere;
mod triangle;

use std::cmp::Ordering;

use dashu_ratio::RBig;
use rayproof_scene::{FlatHit, Ray};

use self::judged_ray::residual;
use self::promise::{Promise, ROUNDOFF};
pub use self::{
    bits::{BitComparison, compare_bits, ulp_distance},
    judged_ray::{Answer, Fault, JudgedRay},
};
use crate::{ExactHit, Oracle};

/// `u + v` of a hit may exceed one by the roundings of two quotients and a sum.
const WEIGHTS: f64 = 1.0 + 8.0 * ROUNDOFF;

/// What the judge says of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// A miss that is one, or the exact hit with its numbers within their bounds.
    Exact(Errors),
    /// Another answer, which single precision may give.
    WithinPromise(Box<JudgedRay>),
    /// A wrong answer.
    Disagrees(Fault, Box<JudgedRay>),
}

/// How far the numbers of a hit are off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// ULPs between `t` and the exact one rounded to the nearest.
    pub t: u64,
    /// The error of `u`, in ULP.
    pub u: u64,
    /// The error of `v`, in ULP.
    pub v: u64,
    /// The largest error over its bound, at most 1: how much of the promise is used. 0 where nothing is promised.
    pub of_promise: f64,
}

impl Verdict {
    /// Whether the answer is right or allowed.
    #[must_use]
    pub fn is_accepted(&self) -> bool {
        !matches!(self, Self::Disagrees(..))
    }

    /// Whether the answer is the exact one with its numbers rounded to the nearest: the promise of the precision `exact`.
    #[must_use]
    pub fn is_nearest(&self) -> bool {
        matches!(self, Self::Exact(Errors { t: 0, u: 0, v: 0, .. }))
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exact(Errors { t, u, v, of_promise }) => {
                writeln!(f, "exact: t off by {t} ULP, u by {u}, v by {v}; {of_promise:.3} of the bound")
            }
            Self::WithinPromise(case) => write!(f, "within the promise of single precision\n{case}"),
            Self::Disagrees(fault, case) => write!(f, "disagrees: {fault}\n{case}"),
        }
    }
}

/// Judges an answer to the query `closest`.
#[must_use]
pub fn judge_closest(oracle: &Oracle, ray: &Ray, answer: &FlatHit) -> Verdict {
    let hits = oracle.all(ray);
    let exact = hits.first().map_or(FlatHit::MISS, ExactHit::to_hit);
    let case = || {
        let residual = residual(oracle.scene(), ray, answer);
        let [exact, answer] = [exact, *answer].map(|hit| Answer::closest(oracle.scene(), hit));
        Box::new(JudgedRay { ray: *ray, exact, answer, residual })
    };
    match compare_closest(oracle, ray, answer, &hits) {
        Err(fault) => Verdict::Disagrees(fault, case()),
        Ok(None) => Verdict::WithinPromise(case()),
        Ok(Some(of_promise)) => Verdict::Exact(Errors {
            t: ulp_distance(answer.t, exact.t),
            u: ulp_distance(answer.u, exact.u),
            v: ulp_distance(answer.v, exact.v),
            of_promise,
        }),
    }
}

/// How much of the bound is used by an answer that is exact; `None` for another that is within the promise.
fn compare_closest(oracle: &Oracle, ray: &Ray, answer: &FlatHit, hits: &[ExactHit]) -> Result<Option<f64>, Fault> {
    let exact = hits.first();
    if !answer.is_hit() {
        if !answer.same_bits(&FlatHit::MISS) {
            return Err(if is_nan(answer) { Fault::NotANumber } else { Fault::MalformedMiss });
        }
        clear_hit(oracle, ray, hits, None)?;
        return Ok(exact.is_none().then_some(0.0));
    }
    let promise = check_form(oracle, ray, answer)?;
    lower_twin(oracle, hits, answer.primitive)?;
    let of_promise = promise.claim(answer);
    let same = exact.filter(|e| e.primitive == answer.primitive);
    if of_promise.is_nan() || of_promise > 1.0 {
        return Err(if same.is_some() { Fault::WrongNumbers(of_promise) } else { Fault::FalseHit(of_promise) });
    }
    clear_hit(oracle, ray, hits, Some(answer.t))?;
    // The other root of the same sphere is another hit.
    let same_root = |e: &ExactHit| promise.confuses_t(&e.t, answer.t) || e.t.to_f32() == answer.t;
    Ok(same.is_some_and(same_root).then_some(of_promise))
}

/// Judges an answer to the query `any`, 0 or 1.
#[must_use]
pub fn judge_any(oracle: &Oracle, ray: &Ray, answer: u8) -> Verdict {
    let hits = oracle.all(ray);
    let exact = u8::from(!hits.is_empty());
    let case =
        || Box::new(JudgedRay { ray: *ray, exact: Answer::Any(exact), answer: Answer::Any(answer), residual: None });
    if answer > 1 {
        return Verdict::Disagrees(Fault::NotAFlag, case());
    }
    if answer == exact {
        return Verdict::Exact(Errors::default());
    }
    let fault = match answer {
        0 => clear_hit(oracle, ray, &hits, None).err(),
        _ => (possible_hits(oracle, ray) == 0).then_some(Fault::Unaccounted),
    };
    fault.map_or_else(|| Verdict::WithinPromise(case()), |fault| Verdict::Disagrees(fault, case()))
}

/// Judges an answer to the query `count`.
///
/// In single precision every crossing that is not clear may be counted or not.
#[must_use]
pub fn judge_count(oracle: &Oracle, ray: &Ray, answer: u32) -> Verdict {
    let exact = oracle.count(ray);
    if answer == exact {
        return Verdict::Exact(Errors::default());
    }
    let case =
        Box::new(JudgedRay { ray: *ray, exact: Answer::Count(exact), answer: Answer::Count(answer), residual: None });
    let clear =
        oracle.all(ray).iter().filter(|hit| !Promise::of(oracle, ray, hit.primitive).may_miss(ray, hit)).count();
    if (clear..=possible_hits(oracle, ray)).contains(&(answer as usize)) {
        Verdict::WithinPromise(case)
    } else {
        Verdict::Disagrees(Fault::Unaccounted, case)
    }
}

/// What a hit must look like, whatever the scene.
fn check_form(oracle: &Oracle, ray: &Ray, answer: &FlatHit) -> Result<Promise, Fault> {
    let FlatHit { t, u, v, primitive } = *answer;
    if is_nan(answer) {
        return Err(Fault::NotANumber);
    }
    if primitive as usize >= oracle.scene().len() {
        return Err(Fault::NoSuchPrimitive);
    }
    if ray.fault().is_some() || !(ray.t_min..=ray.t_max).contains(&t) {
        return Err(Fault::OutOfRange);
    }
    let promise = Promise::of(oracle, ray, primitive);
    let on_primitive = match promise {
        Promise::Triangle(_) => u >= 0.0 && v >= 0.0 && f64::from(u) + f64::from(v) <= WEIGHTS,
        Promise::Sphere(_) => u == 0.0 && v == 0.0,
    };
    if on_primitive { Ok(promise) } else { Err(Fault::OutsidePrimitive) }
}

/// Fails when single precision hits one of the exact hits for sure, and before `t` where there is one.
fn clear_hit(oracle: &Oracle, ray: &Ray, hits: &[ExactHit], t: Option<f32>) -> Result<(), Fault> {
    let before = |hit: &&ExactHit| match t.map(RBig::try_from) {
        Some(Ok(t)) => hit.t.cmp_rational(&t) == Ordering::Less,
        // No answer, or one at infinity.
        _ => true,
    };
    let clear = |hit: &&ExactHit| {
        let promise = Promise::of(oracle, ray, hit.primitive);
        !promise.may_miss(ray, hit) && !t.is_some_and(|t| promise.confuses_t(&hit.t, t))
    };
    match hits.iter().take_while(before).find(clear) {
        Some(hit) => Err(Fault::PassedOver { primitive: hit.primitive, t: hit.t.to_f32() }),
        None => Ok(()),
    }
}

/// Fails when the ray hits a copy of the primitive with a lower number: both give the same bits, so it goes first.
fn lower_twin(oracle: &Oracle, hits: &[ExactHit], primitive: u32) -> Result<(), Fault> {
    let shape = |flat: u32| oracle.scene().primitive(flat as usize);
    match hits.iter().find(|hit| hit.primitive < primitive && shape(hit.primitive) == shape(primitive)) {
        Some(hit) => Err(Fault::PassedOver { primitive: hit.primitive, t: hit.t.to_f32() }),
        None => Ok(()),
    }
}

/// How many hits single precision may find at most.
fn possible_hits(oracle: &Oracle, ray: &Ray) -> usize {
    if ray.fault().is_some() {
        return 0;
    }
    let promises = (0..oracle.scene().len()).map(|flat| Promise::new(ray, &oracle.scene().primitive(flat)));
    promises
        .map(|promise| match promise {
            Promise::Triangle(promise) => usize::from(promise.may_hit(ray)),
            Promise::Sphere(promise) => 2 * usize::from(promise.may_hit(ray)),
        })
        .sum()
}

fn is_nan(hit: &FlatHit) -> bool {
    hit.t.is_nan() || hit.u.is_nan() || hit.v.is_nan()
}
