//! The refinement of `shaders/exact/round/refined_triangle.wgsl`, step by step, in an arithmetic that flushes subnormals and whose
//! quotients are loose. (Sums and products are to the nearest: where they are not, no error-free transform survives, and a device
//! is not given this kernel.)

use super::*;
use crate::twin::exact::number::Number;
use crate::twin::exact::number::pair::{Two, two_product, two_sum};
use crate::twin::exact::vector::{cross_n, dot_n};

type Words = Vector<Two<Adverse>>;

/// What the kernel's bounds are made of.
#[derive(Clone, Copy)]
struct Bounds {
    side: f32,
    plane: f32,
    round: f32,
    determinant: f32,
    /// What the steps lose, of their largest term; of their products with low words; and of the middle word left out.
    lost: f32,
    low: f32,
    middle: f32,
}

const ROUNDOFF: f32 = power_of_two(-23);

const USED: Bounds = Bounds {
    side: 20.0 * ROUNDOFF,
    plane: 54.0 * ROUNDOFF,
    round: 8.0 * ROUNDOFF,
    determinant: 20.0 * ROUNDOFF,
    lost: power_of_two(-60),
    low: ROUNDOFF,
    middle: 1.0,
};

/// What makes some bound too small.
type Damage = fn(&mut Bounds);

fn zip(a: Vector<Adverse>, b: Vector<Adverse>) -> Words {
    Vector { x: two_sum(a.x, b.x), y: two_sum(a.y, b.y), z: two_sum(a.z, b.z) }
}

fn high(v: Words) -> Vector<Adverse> {
    v.map(|x| x.high)
}

fn low(v: Words) -> Vector<Adverse> {
    v.map(|x| x.low)
}

fn negated(v: Vector<Adverse>) -> Vector<Adverse> {
    v.map(|x| -x)
}

fn times(v: Vector<Adverse>, s: Adverse) -> Vector<Adverse> {
    v.map(|x| x * s)
}

/// The kernel's `Three`.
#[derive(Clone, Copy)]
struct Three {
    high: Vector<Adverse>,
    middle: Vector<Adverse>,
    low: Vector<Adverse>,
}

fn renewed(a: Vector<Adverse>, b: Vector<Adverse>, c: Vector<Adverse>) -> Three {
    let first = zip(a, b);
    let second = zip(low(first), c);
    let upper = zip(high(first), high(second));
    let middle = zip(low(upper), low(second));
    Three { high: high(upper), middle: high(middle), low: low(middle) }
}

fn add_all(parts: &[Vector<Adverse>]) -> Vector<Adverse> {
    let sum = |a: Vector<Adverse>, b: &Vector<Adverse>| Vector { x: a.x + b.x, y: a.y + b.y, z: a.z + b.z };
    parts[1..].iter().fold(parts[0], sum)
}

fn lessened(p: &Three, x: [Adverse; 3], d: Vector<Adverse>, e1: Words, e2: Words) -> Three {
    let product = |v: Vector<Adverse>, s: Adverse| v.map(|x| two_product(x, s));
    let (along, first, second) = (product(d, -x[0]), product(high(e1), -x[1]), product(high(e2), x[2]));
    let a = zip(p.high, high(along));
    let b = zip(high(a), high(first));
    let c = zip(high(b), high(second));
    let lows =
        [low(a), low(along), low(b), low(first), times(low(e1), -x[1]), low(c), low(second), times(low(e2), x[2])];
    let (mut sum, mut thirds) = (p.middle, vec![p.low]);
    for part in lows {
        let next = zip(sum, part);
        sum = high(next);
        thirds.push(low(next));
    }
    renewed(high(c), sum, add_all(&thirds))
}

/// `t`, `u` and `v`, each with what it may be away from the exact one; `None` where the determinant is not clear of zero.
fn refined(
    case: &Case,
    corners: [Vector<Adverse>; 3],
    edge: Adverse,
    bounds: Bounds,
) -> Option<[(Adverse, Adverse); 3]> {
    let k = Adverse::new;
    let line = case.line(ROUNDOFF);
    let d = line.direction;
    let [a, b, c] = corners;
    let (e1, e2) = (zip(a, negated(b)), zip(c, negated(a)));
    let p = zip(a, negated(line.origin));
    let p0 = Three { high: high(p), middle: low(p), low: Vector::from([k(0.0); 3]) };

    let normal = cross_n(high(e2), high(e1));
    let determinant = dot_n(normal, d);
    let tiny = line.tiny_triangle;
    let side = k(bounds.side) * d.manhattan() * edge;
    let off_determinant = k(bounds.determinant) * d.manhattan() * edge * edge + tiny;
    if !(k(4.0) * off_determinant).less(determinant.abs()) {
        return None;
    }
    let inverse = k(1.0) / determinant;
    let solved = |p: Vector<Adverse>| {
        let r = cross_n(p, d);
        [dot_n(normal, p) * inverse, dot_n(r, high(e2)) * inverse, dot_n(r, high(e1)) * inverse]
    };
    let x0 = solved(p0.high);
    let p1 = lessened(&p0, x0, d, e1, e2);
    let x1 = solved(p1.high);
    let p2 = lessened(&p1, x1, d, e1, e2);
    let x2 = solved(p2.high);

    let low_word = low(e1).largest().max(low(e2).largest());
    let lost_by = |p: &Three, x: [Adverse; 3]| {
        let weights = x[1].abs() + x[2].abs();
        let terms = p.high.largest() + x[0].abs() * d.largest() + weights * edge;
        terms * k(bounds.lost) + weights * low_word * k(bounds.low)
    };
    let lost = lost_by(&p0, x0) + lost_by(&p1, x1) + p2.middle.largest() * k(bounds.middle);
    let far = p2.high.largest() + lost * k(0.125 / ROUNDOFF);
    let weight = side * far + tiny;
    let bound = [k(bounds.plane) * edge * edge * far + tiny, weight, weight];
    Some([0, 1, 2].map(|i| {
        let relative = (bound[i] + x2[i].abs() * off_determinant) * (inverse.abs() * k(1.375));
        let off = relative + x2[i].abs() * k(bounds.round);
        let first = two_sum(x0[i], x1[i]);
        let second = two_sum(first.low, x2[i]);
        let sum = two_sum(first.high, second.high);
        (sum.high, (sum.low.abs() + second.low.abs() + off) * k(1.000_001))
    }))
}

/// Half the gap between a number and its nearer neighbour.
fn half_gap(x: f32) -> f32 {
    let power = f32::from_bits(x.abs().to_bits() & 0x7f80_0000);
    power * power_of_two(if x.abs() == power { -25 } else { -24 })
}

/// Of hits of triangles: numbers that were rounded, and in words those that were rounded wrong.
fn try_refined(bounds: Bounds, arithmetic: Arithmetic) -> (usize, usize, Vec<String>) {
    compute_by(arithmetic);
    let random = Draw(RefCell::new(Random::new(7, 0)));
    let (mut hits, mut rounded, mut wrong) = (0, 0, Vec::new());
    for case in std::iter::repeat_with(|| triangle_case(&random)).flatten().take(CASES) {
        let Shape::Triangle(corners) = case.shape else { unreachable!("a triangle") };
        if !case.is_hit(f64::NEG_INFINITY, f64::INFINITY) {
            continue;
        }
        hits += 1;
        let [a, b, c] = corners;
        let edge = add(b, a, -1.0).into_iter().chain(add(c, a, -1.0)).fold(0.0_f64, |m, x| m.max(x.abs()));
        #[expect(clippy::cast_possible_truncation, reason = "rounded up; an f32 again")]
        let (edge, corners) =
            (Adverse::new((edge as f32).next_up()), corners.map(|p| Vector::from(p.map(|x| Adverse::new(x as f32)))));
        let Some(found) = refined(&case, corners, edge, bounds) else { continue };
        let ray = ExactRay {
            origin: case.origin.map(f64::from),
            direction: case.direction.map(f64::from),
            t_min: f64::NEG_INFINITY,
            t_max: f64::INFINITY,
        };
        let exact = resolve::rounded(&ray, &case.shape, 0, [0.0; 3]);
        for (i, (r, away)) in found.into_iter().enumerate() {
            let (r, away) = (r.value, away.value);
            if !(power_of_two(-60)..=power_of_two(100)).contains(&r.abs()) || away >= half_gap(r) {
                continue;
            }
            rounded += 1;
            if r != exact[i] {
                wrong.push(format!(
                    "number {i}: {r:e} within {away:e}, exactly {:e}: {case:?} under {arithmetic:?}",
                    exact[i]
                ));
            }
        }
    }
    (hits, rounded, wrong)
}

fn arithmetics() -> impl Iterator<Item = Arithmetic> {
    Arithmetic::all().into_iter().filter(|a| a.rounding == Rounding::Nearest && a.fusing == Fusing::Never)
}

#[test]
fn no_number_is_rounded_wrong_by_refinement() {
    for arithmetic in arithmetics() {
        let (hits, rounded, wrong) = try_refined(USED, arithmetic);
        println!("{hits} hits, {rounded} numbers rounded, {} wrong: {arithmetic:?}", wrong.len());
        assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(3)].join("\n"));
        assert!(rounded > hits && hits > CASES / 4, "{rounded} of {hits} hits is too few");
    }
}

#[test]
fn refinement_with_bounds_that_are_too_small_is_caught() {
    let careless = Arithmetic { rounding: Rounding::Nearest, fusing: Fusing::Never, loose: true, flushing: true };
    let damages: [(&str, Damage); 2] = [
        ("side", |b| b.side /= 1024.0),
        // Each covers for the others. (What steps lose is too little to show beside `side`.)
        ("plane, determinant and round", |b| (b.plane, b.determinant, b.round) = (0.0, 0.0, 0.0)),
    ];
    for (name, damage) in damages {
        let mut bounds = USED;
        damage(&mut bounds);
        let (_, rounded, wrong) = try_refined(bounds, careless);
        println!("{name} too small: {} wrong of {rounded}", wrong.len());
        assert!(!wrong.is_empty(), "{name} may be too small and nothing shows it");
    }
}
