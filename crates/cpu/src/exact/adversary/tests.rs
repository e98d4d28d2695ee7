//! No certificate is wrong under any arithmetic that the rules allow; and bounds that are too small are caught.
#![expect(clippy::print_stdout, reason = "it says how much it tried")]

use std::cell::RefCell;

use rayproof_scene::random::Random;

use super::{Adverse, Arithmetic, Fusing, Rounding, compute_by};
use crate::exact::resolve::{self, ExactRay, Shape};
use crate::lanes::Corners;
use crate::twin::bvh::slab::unit_direction;
use crate::twin::exact::line::Line;
use crate::twin::exact::vector::Vector;
use crate::twin::exact::{sphere, triangle};
use crate::twin::math::power_of_two;

mod refined;

/// Hard cases a shape and arithmetic.
const CASES: usize = 20_000;

struct Draw(RefCell<Random>);

impl Draw {
    fn below(&self, n: u64) -> u64 {
        self.0.borrow_mut().below(n)
    }

    /// From -1 to 1; now and then a small whole number over 8, so that things meet exactly.
    fn unit(&self) -> f64 {
        match self.below(4) {
            0 => self.below(17) as f64 / 8.0 - 1.0,
            _ => self.below(1 << 24) as f64 / f64::from(1 << 23) - 1.0,
        }
    }

    fn point(&self) -> [f64; 3] {
        [self.unit(), self.unit(), self.unit()]
    }

    fn power(&self, low: i32, high: i32) -> f64 {
        2.0_f64.powi(low + i32::try_from(self.below(u64::from(high.abs_diff(low)) + 1)).expect("small"))
    }
}

/// A ray in the units of the first stage, and a shape.
#[derive(Clone, Copy, Debug)]
struct Case {
    origin: [f32; 3],
    direction: [f32; 3],
    shape: Shape,
}

fn add(a: [f64; 3], b: [f64; 3], s: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + s * b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The nearest `f32`; what the first stage would leave open becomes zero.
#[expect(clippy::cast_possible_truncation, reason = "the nearest")]
fn f32s(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| if x.abs() < 2.0_f64.powi(-100) { 0.0 } else { x as f32 })
}

/// A ray from far or near at a target, or past it by a little.
fn aimed(random: &Draw, target: [f64; 3], size: f64, shape: Shape) -> Option<Case> {
    let far = size * random.power(-24, 20);
    let origin = f32s(add(target, random.point(), far.min(2.0_f64.powi(50))));
    let aside = add(target, random.point(), if random.below(2) == 0 { 0.0 } else { size * random.power(-30, -4) });
    let direction = f32s([0, 1, 2].map(|i| (aside[i] - f64::from(origin[i])) / far));
    let unit = unit_direction(direction.into()).direction.to_array();
    let is_lost = unit.iter().any(|x| *x != 0.0 && x.abs() < power_of_two(-100));
    (direction != [0.0; 3] && !is_lost).then_some(Case { origin, direction: unit, shape })
}

/// Triangles of every size, slivers among them, aimed at inside, at edges and at corners.
fn triangle_case(random: &Draw) -> Option<Case> {
    let size = random.power(-70, 20);
    let center = random.point().map(|x| x * size * random.power(-4, 12));
    let a = add(center, random.point(), size);
    let b = add(center, random.point(), size);
    let c = match random.below(3) {
        // A sliver.
        0 => add(add(a, add(b, a, -1.0), random.unit()), random.point(), size * random.power(-22, -3)),
        _ => add(center, random.point(), size),
    };
    let corners = [a, b, c].map(f32s);
    let [a, b, c] = corners.map(|p| p.map(f64::from));
    let (u, v) = (random.below(9) as f64 / 8.0, random.below(9) as f64 / 8.0);
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    let target = add(add(a, add(b, a, -1.0), u), add(c, a, -1.0), v);
    aimed(random, target, size, Shape::Triangle([a, b, c]))
}

/// Spheres of every size, aimed at their middle, at the rim and just beside it.
fn sphere_case(random: &Draw) -> Option<Case> {
    let radius = f32s([random.power(-70, 20) * (1.0 + random.unit().abs()), 0.0, 0.0])[0];
    let size = f64::from(radius);
    let center = f32s(random.point().map(|x| x * size * random.power(-4, 12))).map(f64::from);
    let shape = Shape::Sphere { center, radius: size };
    let mut case = aimed(random, center, size, shape)?;
    // Past the middle by about the radius.
    let d = case.direction.map(f64::from);
    let side = random.point();
    let across = add(side, d, -dot(side, d) / dot(d, d));
    let length = dot(across, across).sqrt();
    if length > 0.0 {
        let off = size * (1.0 + random.unit() * random.power(-24, 0));
        case.origin = f32s(add(case.origin.map(f64::from), across, off / length));
    }
    Some(case)
}

/// What certificates say, and in words what is wrong where one is.
const KINDS: [&str; 6] = [
    "a triangle's miss is a hit",
    "a triangle's hit is none",
    "a triangle's t is not within its bounds",
    "a sphere's miss is a hit",
    "a sphere's root is not within its bounds",
    "a sphere's root is outside the chord",
];

/// Certificates given of each kind, and those that were wrong.
#[derive(Default)]
struct Tally {
    given: [usize; 6],
    open: usize,
    wrong: Vec<String>,
}

impl Tally {
    fn see(&mut self, kind: usize, is_right: bool, case: &Case, arithmetic: Arithmetic) {
        self.given[kind] += 1;
        if !is_right {
            self.wrong.push(format!("{}: {case:?} under {arithmetic:?}", KINDS[kind]));
        }
    }
}

/// What makes some bound too small.
type Damage = fn(&mut Line<Adverse>);

impl Case {
    /// Whether the shape is hit between two numbers.
    fn is_hit(&self, t_min: f64, t_max: f64) -> bool {
        let ray =
            ExactRay { origin: self.origin.map(f64::from), direction: self.direction.map(f64::from), t_min, t_max };
        t_min <= t_max && resolve::is_hit(&ray, &self.shape)
    }

    fn line(&self, u: f32) -> Line<Adverse> {
        let number = |p: [f32; 3]| Vector::from(p.map(Adverse::new));
        let largest = |p: [f64; 3]| p.into_iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let size = match self.shape {
            Shape::Triangle(corners) => corners.map(largest).into_iter().fold(0.0, f64::max),
            Shape::Sphere { center, radius } => largest(center) + radius,
        };
        let reach = (largest(self.origin.map(f64::from)) + size).max(1.0);
        #[expect(clippy::cast_possible_truncation, reason = "a bound")]
        let tiny = [2.0_f64.powi(-110) * reach * size.max(1.0), 2.0_f64.powi(-100), 2.0_f64.powi(-100) * reach * reach]
            .map(|x| x as f32);
        Line::new(u, number(self.origin), number(self.direction), tiny.map(Adverse::new), true)
    }

    fn check(&self, u: f32, damage: Damage, arithmetic: Arithmetic, tally: &mut Tally) {
        let mut line = self.line(u);
        damage(&mut line);
        #[expect(clippy::cast_possible_truncation, reason = "an f32 again")]
        let number = |p: [f64; 3]| Vector::from(p.map(|x| Adverse::new(x as f32)));
        let all = |t: Adverse, off: Adverse| (f64::from((t - off).value), f64::from((t + off).value));
        match self.shape {
            Shape::Triangle(corners) => {
                let [a, b, c] = corners;
                let edge = add(b, a, -1.0).into_iter().chain(add(c, a, -1.0)).fold(0.0_f64, |m, x| m.max(x.abs()));
                #[expect(clippy::cast_possible_truncation, reason = "rounded up")]
                let edge = Adverse::new((edge as f32).next_up());
                let [a, b, c] = corners.map(number);
                let sides = triangle::sides(&line, &Corners { a, b, c, edge });
                let is_hit = self.is_hit(f64::NEG_INFINITY, f64::INFINITY);
                if triangle::triangle_misses(&sides) {
                    return tally.see(0, !is_hit, self, arithmetic);
                }
                let t = triangle::plane_t(&line, &sides, edge);
                let crosses = triangle::triangle_crosses(&sides);
                if crosses {
                    tally.see(1, is_hit, self, arithmetic);
                }
                if t.clear && is_hit {
                    let (low, high) = all(t.value, t.off);
                    tally.see(2, self.is_hit(low, high), self, arithmetic);
                }
                tally.open += usize::from(!(crosses && t.clear));
            }
            Shape::Sphere { center, radius } => {
                #[expect(clippy::cast_possible_truncation, reason = "an f32 again")]
                let chord = sphere::chord(&line, number(center), Adverse::new(radius as f32));
                let sphere::Chord { misses, enters, middle, half, off } = chord;
                if misses {
                    let is_hit = self.is_hit(f64::NEG_INFINITY, f64::INFINITY);
                    return tally.see(3, !is_hit, self, arithmetic);
                }
                let (near, far) = (all(middle - half, off), all(middle + half, off));
                if enters {
                    let both = self.is_hit(near.0, near.1) && self.is_hit(far.0, far.1);
                    tally.see(4, both, self, arithmetic);
                }
                let outside =
                    self.is_hit(f64::NEG_INFINITY, near.0.next_down()) || self.is_hit(far.1.next_up(), f64::INFINITY);
                tally.see(5, !outside, self, arithmetic);
                tally.open += usize::from(!enters);
            }
        }
    }
}

/// Tries the certificates with the roundoff `u` under an arithmetic.
fn try_out(u: f32, damage: Damage, arithmetic: Arithmetic, tally: &mut Tally) {
    compute_by(arithmetic);
    let random = Draw(RefCell::new(Random::new(7, 0)));
    for make in [triangle_case, sphere_case] {
        for case in std::iter::repeat_with(|| make(&random)).flatten().take(CASES) {
            case.check(u, damage, arithmetic, tally);
        }
    }
}

#[test]
fn no_certificate_is_wrong_under_any_arithmetic() {
    let mut tally = Tally::default();
    let all = Arithmetic::all();
    for &arithmetic in &all {
        try_out(power_of_two(-23), |_| {}, arithmetic, &mut tally);
    }
    // IEEE: the nearest, and correctly rounded quotients and roots. Fusing only drops errors.
    let ieee = all.iter().filter(|a| a.rounding == Rounding::Nearest && !a.loose);
    let mut tries = all.len();
    for &arithmetic in ieee {
        try_out(power_of_two(-24), |_| {}, arithmetic, &mut tally);
        tries += 1;
    }
    let Tally { given, open, wrong } = tally;
    println!("{given:?} certificates under {tries} arithmetics, {} wrong; {open} cases left open", wrong.len());
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(3)].join("\n"));
    assert!(given.iter().all(|&n| n > 100 * tries), "{given:?} is too few of a kind");
}

#[test]
fn bounds_that_are_too_small_are_caught() {
    let careless = Arithmetic { rounding: Rounding::Either, fusing: Fusing::ByLot, loose: true, flushing: true };
    let damages: [(&str, Damage); 6] = [
        ("side_error", |l| l.side_error = Adverse::new(l.side_error.value / 64.0)),
        ("plane_error", |l| l.plane_error = Adverse::new(l.plane_error.value / 64.0)),
        ("foot_error", |l| l.foot_error = Adverse::new(l.foot_error.value / 64.0)),
        // Each covers for the other.
        ("middle_error and root_error", |l| {
            l.middle_error = Adverse::new(l.middle_error.value / 64.0);
            l.root_error = Adverse::new(l.root_error.value / 64.0);
        }),
        ("tiny_triangle", |l| l.tiny_triangle = Adverse::new(0.0)),
        ("tiny_sphere", |l| l.tiny_sphere = Adverse::new(0.0)),
    ];
    for (name, damage) in damages {
        let mut tally = Tally::default();
        try_out(power_of_two(-23), damage, careless, &mut tally);
        println!("{name} too small: {} wrong of {:?}", tally.wrong.len(), tally.given);
        assert!(!tally.wrong.is_empty(), "{name} may be too small and nothing shows it");
    }
}
