//! No ray that touches a box, in exact arithmetic, may be told that it does not.
//!
//! Positions are whole numbers times a power of two, so that what touches is known exactly: a ray is aimed at a point of a
//! box's corner, edge, face or inside, often along a face or an edge, and reaches it at a parameter that is a power of two.
#![expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
#![expect(clippy::print_stdout, reason = "a test says its seed")]

use rayproof_scene::random::Random;

use super::*;

const RAYS: usize = 300_000;
const SEED: u64 = 0x51ab;

struct Draw(Random);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0.bits() >> 33
    }

    fn one_in(&mut self, n: u64) -> bool {
        self.next().is_multiple_of(n)
    }

    fn within(&mut self, low: i32, high: i32) -> i32 {
        low + (self.next() as i32) % (high - low + 1)
    }
}

/// A box, a ray in box units, and the parameter at which it reaches a point of the box.
#[derive(Clone, Copy, Debug)]
struct Touch {
    low: Vec3,
    high: Vec3,
    origin: Vec3,
    direction: Vec3,
    size: f32,
    s: f32,
}

/// Whole numbers `(from, to, point)` with `from + m to = point`, each an `f32`, though `point - from` may be none.
fn axis(r: &mut Draw, m: i64) -> (i64, i64, i64) {
    let bits = r.within(1, 24);
    let to = i64::from(r.within(-(1 << bits) + 1, (1 << bits) - 1));
    let product = m * to;
    if r.one_in(3) {
        // In the plane through the point: this component of the direction is zero.
        let from = i64::from(r.within(-(1 << bits) + 1, (1 << bits) - 1));
        (from, 0, from)
    } else if product.abs() < 1 << 22 {
        let from = i64::from(r.within(-(1 << 22), 1 << 22));
        (from, to, from + product)
    } else {
        // What rounding the product leaves over is the point.
        let from = -(product as f32) as i64;
        (from, to, from + product)
    }
}

fn touch(r: &mut Draw) -> Option<Touch> {
    let m = i64::from(r.within(1, 1023));
    let [mut low, mut high, mut origin, mut to] = [Vec3::ZERO; 4];
    for i in 0..3 {
        let (from, towards, point) = axis(r, m);
        // The point is on the low plane, on the high one, between, or the box is flat.
        let reach = 1 << r.within(0, 10);
        let room = [0, i64::from(r.within(0, reach))];
        let (below, above) = (room[usize::from(r.one_in(2))], room[usize::from(r.one_in(2))]);
        (low[i], high[i]) = ((point - below) as f32, (point + above) as f32);
        origin[i] = from as f32;
        to[i] = if towards == 0 && r.one_in(2) { -0.0 } else { towards as f32 };
    }
    if to == Vec3::ZERO {
        return None;
    }
    let unit = power_of_two(r.within(-30, 30));
    let stretch = power_of_two(r.within(-50, 50));
    // origin + s d = the point, for d = to unit stretch 2^-exponent.
    let UnitDirection { direction, exponent } = unit_direction(to * unit * stretch);
    let s = m as f32 * power_of_two(exponent) / stretch;
    let size = 2.0_f32.powf(largest(low.into()).max(largest(high.into())).max(1.0).log2().ceil()) * unit;
    Some(Touch { low: low * unit, high: high * unit, origin: origin * unit, direction: direction.into(), size, s })
}

fn touches() -> Vec<Touch> {
    println!("seed {SEED:#x}, {RAYS} rays that touch");
    let mut r = Draw(Random::new(SEED, 0));
    std::iter::repeat_with(|| touch(&mut r)).flatten().take(RAYS).collect()
}

fn node(t: &Touch, slot: usize) -> UnpackedNode {
    let planes = |x: f32, empty: f32| {
        let mut lanes = [empty; 4];
        lanes[slot] = x;
        Vec4::from(lanes)
    };
    let (low, high) = (|i: usize| planes(t.low[i], f32::INFINITY), |i: usize| planes(t.high[i], f32::NEG_INFINITY));
    UnpackedNode { planes: [low(0), high(0), low(1), high(1), low(2), high(2), Vec4::ZERO, Vec4::ZERO] }
}

#[test]
fn every_box_that_is_touched_is_met() {
    for (i, t) in touches().iter().enumerate() {
        let params = Params { scene_exponent: 0, scene_size: t.size, plain: true, chords: false };
        // The range shrunk to the touch itself, and the ray from beyond it looking back.
        for (direction, s) in [(t.direction, t.s), (-t.direction, -t.s)] {
            let ray = box_ray(&params, t.origin.into(), direction.into(), s);
            let keys = child_keys(&ray, &node(t, i % 4), s);
            assert_eq!(keys.met, 1 << (i % 4), "{t:?}");
            let key = keys.keys[i % 4];
            assert!(key <= s && key.to_bits() & 3 == i as u32 % 4, "key {key} at {t:?}");
        }
    }
}

/// The slab test once more, under all that WGSL allows: either neighbour of every exact result, 2.5 ULP of a reciprocal,
/// subnormals flushed or not. Each result is chosen at random, or always to shorten the interval.
struct Adversary<'a> {
    random: &'a mut Draw,
    /// Where results are pushed: away from zero, towards it, or at random.
    push: std::cmp::Ordering,
}

impl Adversary<'_> {
    fn away(&mut self) -> bool {
        match self.push {
            std::cmp::Ordering::Greater => true,
            std::cmp::Ordering::Less => false,
            std::cmp::Ordering::Equal => self.random.one_in(2),
        }
    }

    fn either(&mut self, exact: f64) -> f32 {
        let near = exact as f32;
        let other = match f64::from(near) - exact {
            e if e > 0.0 => near.next_down(),
            e if e < 0.0 => near.next_up(),
            _ => near,
        };
        let (large, small) = if near.abs() > other.abs() { (near, other) } else { (other, near) };
        let x = if self.away() { large } else { small };
        if x.is_subnormal() && self.random.one_in(2) { 0.0 } else { x }
    }

    fn sub(&mut self, a: f32, b: f32) -> f32 {
        self.either(f64::from(a) - f64::from(b))
    }

    fn mul(&mut self, a: f32, b: f32) -> f32 {
        self.either(f64::from(a) * f64::from(b))
    }

    /// Up to 2.5 ULP off: two steps from the nearest.
    fn reciprocal(&mut self, x: f32) -> f32 {
        let mut y = 1.0 / x;
        for _ in 0..2 {
            y = if self.away() == (y > 0.0) { y.next_up() } else { y.next_down() };
        }
        y
    }

    /// Whether the box is met at s alone; the same steps as `box_ray` and `child_keys`.
    fn met(&mut self, t: &Touch, worst: bool) -> bool {
        use std::cmp::Ordering;
        // The interval shrinks where what is entered grows and what is left falls.
        let (later, sooner) = match worst {
            false => (Ordering::Equal, Ordering::Equal),
            true if t.s > 0.0 => (Ordering::Greater, Ordering::Less),
            true => (Ordering::Less, Ordering::Greater),
        };
        let reach = self.either(f64::from(largest(t.origin.into())) + f64::from(t.size));
        let slack = t.size * power_of_two(-40);
        let (mut enter, mut leave) = (f32::NEG_INFINITY, f32::INFINITY);
        for i in 0..3 {
            let (o, d) = (t.origin[i], t.direction[i]);
            let still = d.abs() < SMALLEST_DIRECTION;
            let d = if still { SMALLEST_DIRECTION } else { d };
            let slack = self.mul(reach, power_of_two(-50)).max(self.mul(o.abs(), power_of_two(-22)));
            let from_low = if still { self.either(f64::from(o) + f64::from(slack)) } else { o };
            let from_high = if still { self.sub(o, slack) } else { o };
            let (first, last) = if d < 0.0 { (t.high[i], t.low[i]) } else { (t.low[i], t.high[i]) };
            let (from_near, from_far) = if d < 0.0 { (from_high, from_low) } else { (from_low, from_high) };
            let mut plane = |push, plane, from| {
                self.push = push;
                let (distance, inverse) = (self.sub(plane, from), self.reciprocal(d));
                self.mul(distance, inverse)
            };
            enter = enter.max(plane(later, first, from_near));
            leave = leave.min(plane(sooner, last, from_far));
        }
        self.push = later;
        let enter = self.mul(enter, if enter > 0.0 { NARROW } else { WIDEN });
        let near = self.sub(enter, slack);
        self.push = sooner;
        let leave = self.mul(leave, if leave > 0.0 { WIDEN } else { NARROW });
        let far = self.either(f64::from(leave) + f64::from(slack));
        // The slot in the two lowest bits moves the key by up to three.
        let key = f32::from_bits(near.to_bits() & !3 | 3);
        near <= far && key <= t.s && near <= t.s && far >= t.s
    }
}

#[test]
fn no_arithmetic_that_wgsl_allows_loses_a_touch() {
    let mut choices = Draw(Random::new(99, 0));
    for t in touches() {
        for worst in [true, false, false, false] {
            let mut adversary = Adversary { random: &mut choices, push: std::cmp::Ordering::Equal };
            assert!(adversary.met(&t, worst), "{t:?}");
        }
    }
}

#[test]
fn boxes_far_from_the_ray_are_not_met() {
    // The pad is no blanket: a box a thousandth of its distance aside is left out.
    let mut left_out = 0;
    for t in touches() {
        let params = Params { scene_exponent: 0, scene_size: t.size, plain: true, chords: false };
        let aside = t.direction.cross(Vec3::new(0.3, 0.7, 0.1)).normalize_or_zero() * t.size * 8.0;
        let ray = box_ray(&params, (t.origin + aside).into(), t.direction.into(), f32::NEG_INFINITY);
        left_out += usize::from(child_keys(&ray, &node(&t, 0), FARTHEST).met == 0);
    }
    assert!(left_out > RAYS * 9 / 10, "{left_out} of {RAYS}");
}
