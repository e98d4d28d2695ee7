//! A second oracle, so that no one has to take the first one's word: other arithmetic, other formulas, brute force too.
//!
//! Where the first divides rationals, this one adds up floating-point expansions; where the first shifts vertices and compares
//! square roots, this one solves Cramer's system and asks for the sign of the quadratic itself. They share the scene's types
//! and the contract of what a hit is, and nothing else: this one's `Line`, `Root` and `Vector` are others than the first one's, by
//! the names that both have from the field.

mod expansion;
mod place;
mod reject;

use std::cmp::Ordering;

use rayon::prelude::*;
use rayproof_scene::{FlatHit, Primitive, Ray, Scene};

use self::place::{Known, Line, Parameter, PlaneHit, roots, weight};
use crate::{ExactHit, Oracle};

/// The exact answers to any ray in floating-point expansions.
#[derive(Clone, Copy, Debug)]
pub struct SecondOracle<'s> {
    scene: &'s Scene,
}

/// What the second oracle says of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondAnswer {
    /// The closest hit, its numbers rounded to the nearest `f32`.
    pub hit: FlatHit,
    /// How often the surface is crossed.
    pub count: u32,
}

/// How the two oracles agree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Rays that both answered.
    pub compared: u64,
    /// Rays on which they differ in the hit, in any bit, or in the count.
    pub disagreed: u64,
    /// Rays whose numbers are too far apart for expansions.
    pub beyond: u64,
    /// The first of those on which they differ.
    pub first: Option<String>,
}

/// The closest hit so far.
struct Closest {
    t: Parameter,
    hit: FlatHit,
}

impl<'s> SecondOracle<'s> {
    /// The oracle of a scene whose numbers are all finite.
    #[must_use]
    pub const fn new(scene: &'s Scene) -> Self {
        Self { scene }
    }

    /// The closest hit and the count; `None` where a product of up to eight of the numbers involved leaves the range of `f64`.
    #[must_use]
    pub fn answer(&self, ray: &Ray) -> Option<SecondAnswer> {
        let mut closest: Option<Closest> = None;
        let mut count = 0;
        if ray.fault().is_none() {
            let line = Line::new(ray);
            for flat in 0..self.scene.len() {
                let number = u32::try_from(flat).expect("brute force asks no 2^32 primitives");
                match self.scene.primitive(flat) {
                    Primitive::Triangle(triangle) if !reject::misses_triangle(ray, &triangle) => {
                        let Some(plane) = PlaneHit::new(&line, &triangle)? else { continue };
                        // What the shifted line crosses, the line itself meets.
                        if plane.inside && holds(ray, &plane.t)? {
                            count += u32::from(plane.crosses);
                            let [u, v] = [weight(&plane.u)?, weight(&plane.v)?];
                            closest = nearer(closest, plane.t, FlatHit { t: 0.0, u, v, primitive: number })?;
                        }
                    }
                    Primitive::Sphere(sphere) if !reject::misses_sphere(ray, &sphere) => {
                        for t in roots(&line, &sphere)? {
                            if holds(ray, &t)? {
                                count += 1;
                                closest = nearer(closest, t, FlatHit { t: 0.0, u: 0.0, v: 0.0, primitive: number })?;
                            }
                        }
                    }
                    _ => {}
                }
            }
        }
        let hit = match closest {
            Some(Closest { t, hit }) => FlatHit { t: t.nearest()?, ..hit },
            None => FlatHit::MISS,
        };
        Some(SecondAnswer { hit, count })
    }
}

/// Whether the ray's range holds a place, its ends included.
fn holds(ray: &Ray, t: &Parameter) -> Known<bool> {
    let not_below = ray.t_min == f32::NEG_INFINITY || t.order(f64::from(ray.t_min))? != Ordering::Less;
    let not_above = ray.t_max == f32::INFINITY || t.order(f64::from(ray.t_max))? != Ordering::Greater;
    Some(not_below && not_above && ray.t_min < f32::INFINITY && ray.t_max > f32::NEG_INFINITY)
}

/// The closer of two; of equal ones the first, which has the lower number.
fn nearer(before: Option<Closest>, t: Parameter, hit: FlatHit) -> Known<Option<Closest>> {
    let Some(before) = before else { return Some(Some(Closest { t, hit })) };
    // Estimates a millionth apart are in order: they are good to some fifty bits.
    let (old, new) = (before.t.estimate(), t.estimate());
    let apart = (old - new).abs() > 1e-6 * old.abs().max(new.abs());
    let is_less = if apart { new < old } else { t.order_of(&before.t)? == Ordering::Less };
    Some(Some(if is_less { Closest { t, hit } } else { before }))
}

/// Asks both oracles about every ray.
#[must_use]
pub fn compare(scene: &Scene, rays: &[Ray]) -> Agreement {
    let closest = |oracle: &Oracle, ray: &Ray| oracle.closest(ray).as_ref().map_or(FlatHit::MISS, ExactHit::to_hit);
    compare_hits(scene, rays, &Oracle::new(scene).batch(rays, closest))
}

/// As [`compare`], where the first oracle's closest hits, rounded, are known.
///
/// # Panics
/// When `rays` and `hits` differ in length.
#[must_use]
pub fn compare_hits(scene: &Scene, rays: &[Ray], hits: &[FlatHit]) -> Agreement {
    assert_eq!(rays.len(), hits.len(), "one hit a ray");
    let (first, second) = (Oracle::new(scene), SecondOracle::new(scene));
    let one = |(ray, hit): (&Ray, &FlatHit)| judge(ray, *hit, first.count(ray), second.answer(ray));
    rays.par_iter().zip(hits).map(one).reduce(Agreement::default, Agreement::with)
}

impl Agreement {
    /// Both of two.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            compared: self.compared + other.compared,
            disagreed: self.disagreed + other.disagreed,
            beyond: self.beyond + other.beyond,
            first: self.first.or(other.first),
        }
    }
}

/// One ray.
fn judge(ray: &Ray, exact: FlatHit, count: u32, second: Option<SecondAnswer>) -> Agreement {
    let Some(second) = second else { return Agreement { beyond: 1, ..Agreement::default() } };
    let agrees = exact.same_bits(&second.hit) && count == second.count;
    let first =
        (!agrees).then(|| format!("{ray:?}\n  rationals  {exact:?}, {count} crossings\n  expansions {second:?}"));
    Agreement { compared: 1, disagreed: u64::from(!agrees), beyond: 0, first }
}

#[cfg(test)]
mod tests;
