//! What a pixel shows of a hit.

use glam::Vec3;
use rayproof_oracle::judge::ulp_distance;
use rayproof_scene::normal::{facing, normal};
use rayproof_scene::{FlatHit, Ray, Scene};

use crate::color::{self, BACKGROUND, Rgb, WRONG};

/// The geometric normal on the viewer's side as red, green and blue, lit by a lamp at the eye.
#[must_use]
pub fn by_normal(scene: &Scene, ray: &Ray, hit: &FlatHit) -> Rgb {
    if !hit.is_hit() {
        return BACKGROUND;
    }
    let d = ray.direction.as_dvec3();
    let p = ray.origin.as_dvec3() + d * f64::from(hit.t);
    let n = facing(normal(scene, hit, p), d);
    let lamp = 0.35 + 0.65 * n.dot(-d.normalize());
    color::from_unit(((n * 0.5 + 0.5) * lamp).as_vec3())
}

/// A colour of its own for every primitive.
#[must_use]
pub fn by_primitive(hit: &FlatHit) -> Rgb {
    if hit.is_hit() { color::distinct(hit.primitive) } else { BACKGROUND }
}

/// The weights of the three vertices as red, green and blue.
#[must_use]
pub fn by_uv(hit: &FlatHit) -> Rgb {
    if hit.is_hit() { color::from_unit(Vec3::new(1.0 - hit.u - hit.v, hit.u, hit.v)) } else { BACKGROUND }
}

/// The error of `t`, given the exact answer; red where it is not even the right primitive.
#[must_use]
pub fn by_error(exact: &FlatHit, hit: &FlatHit) -> Rgb {
    match (exact.primitive == hit.primitive, hit.is_hit()) {
        (false, _) => WRONG,
        (true, false) => BACKGROUND,
        (true, true) => color::of_ulps(ulp_distance(exact.t, hit.t)),
    }
}

/// How an answer stands to the exact one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// A miss, rightly.
    Miss,
    /// The right primitive.
    Hit,
    /// A hit where there is none.
    FalseHit,
    /// A miss where there is a hit: a leak.
    FalseMiss,
    /// Another primitive than the exact one.
    Another,
}

impl Verdict {
    /// All of them, as a legend lists them.
    pub const ALL: [Self; 5] = [Self::Miss, Self::Hit, Self::FalseHit, Self::FalseMiss, Self::Another];

    /// The verdict on an answer.
    #[must_use]
    pub fn of(exact: &FlatHit, hit: &FlatHit) -> Self {
        match (exact.is_hit(), hit.is_hit()) {
            (false, false) => Self::Miss,
            (false, true) => Self::FalseHit,
            (true, false) => Self::FalseMiss,
            (true, true) if exact.primitive == hit.primitive => Self::Hit,
            (true, true) => Self::Another,
        }
    }

    /// What it says of an answer.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Miss => "miss",
            Self::Hit => "hit",
            Self::FalseHit => "false hit",
            Self::FalseMiss => "false miss",
            Self::Another => "another primitive",
        }
    }

    /// Its colour: those of wrong answers are Okabe and Ito's, for eyes that see fewer colours.
    #[must_use]
    pub const fn color(self) -> Rgb {
        match self {
            Self::Miss => BACKGROUND,
            Self::Hit => [92, 98, 110],
            Self::FalseHit => [86, 180, 233],
            Self::FalseMiss => [230, 159, 0],
            Self::Another => [204, 121, 167],
        }
    }
}

/// Which stage of the cascade decided: 1 to 3.
#[must_use]
pub fn by_stage(stage: u8) -> Rgb {
    color::STAGES[usize::from(stage.clamp(1, 3)) - 1]
}

/// The distances of a whole picture: the nearest is yellow, the farthest dark blue, and a miss is background.
pub fn by_depth(distances: &[f32]) -> impl Iterator<Item = Rgb> + '_ {
    let hits = || distances.iter().copied().filter(|t| t.is_finite()).map(f64::from);
    let (near, far) = (hits().fold(f64::INFINITY, f64::min), hits().fold(f64::NEG_INFINITY, f64::max));
    let span = (far - near).max(f64::MIN_POSITIVE);
    distances.iter().map(move |&t| match t {
        t if t.is_finite() => color::cividis(1.0 - (f64::from(t) - near) / span),
        _ => BACKGROUND,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_is_the_brightest_and_a_miss_is_background() {
        let colors: Vec<Rgb> = by_depth(&[f32::INFINITY, 2.0, 3.0, 10.0]).collect();
        let light = |c: Rgb| c.iter().map(|&x| u32::from(x)).sum::<u32>();
        assert_eq!(colors[0], BACKGROUND);
        assert_eq!([colors[1], colors[3]], [color::cividis(1.0), color::cividis(0.0)]);
        assert!(light(colors[1]) > light(colors[2]) && light(colors[2]) > light(colors[3]), "{colors:?}");
        assert_eq!(by_depth(&[f32::INFINITY]).collect::<Vec<_>>(), [BACKGROUND]);
        assert_eq!(by_depth(&[4.0]).collect::<Vec<_>>(), [color::cividis(1.0)]);
    }

    #[test]
    fn errors_are_counted_in_ulp_and_wrong_answers_are_red() {
        let exact = FlatHit { t: 2.0, u: 0.0, v: 0.0, primitive: 0 };
        let off = FlatHit { t: f32::from_bits(2.0_f32.to_bits() + 10), ..exact };
        assert_eq!([by_error(&exact, &exact), by_error(&exact, &off)], [0, 10].map(color::of_ulps));
        let other = FlatHit { primitive: 1, ..exact };
        let wrong = [(exact, other), (exact, FlatHit::MISS), (FlatHit::MISS, exact)];
        assert_eq!(wrong.map(|(exact, hit)| by_error(&exact, &hit)), [WRONG; 3]);
        assert_eq!(by_error(&FlatHit::MISS, &FlatHit::MISS), BACKGROUND);
        let verdicts = [
            (exact, off),
            (exact, other),
            (exact, FlatHit::MISS),
            (FlatHit::MISS, exact),
            (FlatHit::MISS, FlatHit::MISS),
        ];
        let expected = [Verdict::Hit, Verdict::Another, Verdict::FalseMiss, Verdict::FalseHit, Verdict::Miss];
        assert_eq!(verdicts.map(|(exact, hit)| Verdict::of(&exact, &hit)), expected);
    }

    #[test]
    fn weights_are_red_green_and_blue() {
        let at = |u, v| by_uv(&FlatHit { t: 1.0, u, v, primitive: 0 });
        assert_eq!([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)], [[255, 0, 0], [0, 255, 0], [0, 0, 255]]);
        assert_eq!(by_uv(&FlatHit::MISS), BACKGROUND);
    }
}
