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
    /// What the steps lose, of their terms; of their products with low words; and of the middle word left out.
    far: f32,
    near: f32,
    low: f32,
    middle: f32,
}

const ROUNDOFF: f32 = power_of_two(-23);

const USED: Bounds = Bounds {
    side: 20.0 * ROUNDOFF,
    plane: 54.0 * ROUNDOFF,
    round: 8.0 * ROUNDOFF,
    determinant: 20.0 * ROUNDOFF,
    far: power_of_two(-64),
    near: power_of_two(-62),
    low: ROUNDOFF,
    middle: 1.0,
};

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

/// `t`, `u` and `v` rounded, where they settle.
fn refined(case: &Case, corners: [Vector<Adverse>; 3], edge: Adverse, bounds: Bounds) -> Option<[f32; 3]> {
    let k = Adverse::new;
    let line = case.line(ROUNDOFF);
    let d = line.direction;
    let [a, b, c] = corners;
    let (e1, e2) = (zip(a, negated(b)), zip(c, negated(a)));
    let from_origin = zip(a, negated(line.origin));
    let mut p = Three { high: high(from_origin), middle: low(from_origin), low: Vector::from([k(0.0); 3]) };

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
    let low_word = low(e1).largest().max(low(e2).largest());
    let lost_by = |p: &Three, x: [Adverse; 3]| {
        let weights = x[1].abs() + x[2].abs();
        let far = p.high.largest().max(x[0].abs() * d.largest());
        let near = (p.high - times(d, x[0])).largest() + weights * edge;
        far * k(bounds.far) + near * k(bounds.near) + weights * low_word * k(bounds.low)
    };
    let mut x = solved(p.high);
    let (mut highs, mut lows, mut left) = (x, [k(0.0); 3], [k(0.0); 3]);
    let (mut lost, mut found) = (k(0.0), None);
    for _ in 0..3 {
        lost = lost + lost_by(&p, x);
        p = lessened(&p, x, d, e1, e2);
        x = solved(p.high);
        let far = p.high.largest() + (lost + p.middle.largest() * k(bounds.middle)) * k(0.125 / ROUNDOFF);
        let weight = side * far + tiny;
        let bound = [k(bounds.plane) * edge * edge * far + tiny, weight, weight];
        let mut settled = true;
        for i in 0..3 {
            let low = two_sum(lows[i], x[i]);
            let sum = two_sum(highs[i], low.high);
            (highs[i], lows[i], left[i]) = (sum.high, sum.low, left[i] + low.low.abs());
            let relative = (bound[i] + x[i].abs() * off_determinant) * (inverse.abs() * k(1.375));
            let away = (left[i] + relative + x[i].abs() * k(bounds.round)) * k(1.000_001);
            let outward = Number::pick(sum.low, -sum.low, sum.high.less(k(0.0)));
            settled &= settles(sum.high.value, (outward + away).value, (away - outward).value);
        }
        if settled {
            found = Some(highs.map(|x| x.value));
            break;
        }
    }
    found
}

/// The kernel's test.
fn settles(r: f32, outward: f32, inward: f32) -> bool {
    let power = f32::from_bits(r.abs().to_bits() & 0x7f80_0000);
    let half = power * power_of_two(-24) * (1.0 - power_of_two(-22));
    let is_power = r.abs() == power;
    (power_of_two(-60)..=power_of_two(100)).contains(&r.abs())
        && outward < half
        && inward < if is_power { 0.5 * half } else { half }
}

/// How many triangles are hit, how many hits are rounded, and in words those that are rounded wrong.
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
        rounded += 1;
        if found != exact {
            wrong.push(format!("{found:?}, exactly {exact:?}: {case:?} under {arithmetic:?}"));
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
        println!("{hits} hits, {rounded} rounded, {} wrong: {arithmetic:?}", wrong.len());
        assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(3)].join("\n"));
        assert!(rounded > hits / 4 && hits > CASES / 4, "{rounded} of {hits} hits is too few");
    }
}

#[test]
fn refinement_with_bounds_that_are_too_small_is_caught() {
    let careless = Arithmetic { rounding: Rounding::Nearest, fusing: Fusing::Never, loose: true, flushing: true };
    // Each covers for the others, and for what steps lose.
    let bounds = Bounds { side: 0.0, plane: 0.0, determinant: 0.0, round: 0.0, ..USED };
    let (_, rounded, wrong) = try_refined(bounds, careless);
    println!("without bounds of the last solve: {} wrong of {rounded}", wrong.len());
    assert!(wrong.len() > 100, "bounds may be too small and nothing shows it");
}
