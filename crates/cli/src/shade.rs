//! What a pixel shows of a hit.

use glam::Vec3;
use rayproof::scene::{Hit, Ray, Scene};
use rayproof_oracle::Oracle;
use rayproof_oracle::judge::ulp_distance;

use crate::bounce::{facing, normal};
use crate::color::{self, BACKGROUND, Rgb, WRONG};
use crate::legend;

/// The geometric normal on the viewer's side as red, green and blue, lit by a lamp at the eye.
pub(crate) fn by_normal(scene: &Scene, ray: &Ray, hit: &Hit) -> Rgb {
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
pub(crate) fn by_primitive(hit: &Hit) -> Rgb {
    if hit.is_hit() { color::distinct(hit.primitive) } else { BACKGROUND }
}

/// The weights of the three vertices as red, green and blue.
pub(crate) fn by_uv(hit: &Hit) -> Rgb {
    if hit.is_hit() { color::from_unit(Vec3::new(1.0 - hit.u - hit.v, hit.u, hit.v)) } else { BACKGROUND }
}

/// The error of `t`, against exact arithmetic; red where it is not even the right primitive.
pub(crate) fn by_error(oracle: &Oracle, ray: &Ray, hit: &Hit) -> Rgb {
    let exact = oracle.closest(ray).map_or(Hit::MISS, |exact| exact.to_hit());
    match (exact.primitive == hit.primitive, hit.is_hit()) {
        (false, _) => WRONG,
        (true, false) => BACKGROUND,
        (true, true) => legend::color(ulp_distance(exact.t, hit.t)),
    }
}

/// Which tier of the cascade decided: 1 to 3.
pub(crate) fn by_tier(tier: u8) -> Rgb {
    color::TIERS[usize::from(tier.clamp(1, 3)) - 1]
}

/// The distances of a whole picture: the nearest is yellow, the farthest dark blue, and a miss is background.
pub(crate) fn by_depth(distances: &[f32]) -> impl Iterator<Item = Rgb> + '_ {
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
    use rayproof::scene::{Geometry, Sphere};

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
        let spheres = vec![Sphere { center: Vec3::ZERO, radius: 1.0 }, Sphere { center: Vec3::X * 9.0, radius: 1.0 }];
        let scene = Scene::new(vec![Geometry::Spheres(spheres)]);
        let oracle = Oracle::new(&scene);
        let ray = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z);
        let hit = |t, primitive| by_error(&oracle, &ray, &Hit { t, u: 0.0, v: 0.0, primitive });
        assert_eq!(hit(2.0, 0), legend::color(0));
        assert_eq!(hit(f32::from_bits(2.0_f32.to_bits() + 10), 0), legend::color(10));
        assert_eq!([hit(2.0, 1), by_error(&oracle, &ray, &Hit::MISS)], [WRONG, WRONG]);
        let away = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::Z);
        assert_eq!(by_error(&oracle, &away, &Hit::MISS), BACKGROUND);
    }

    #[test]
    fn weights_are_red_green_and_blue() {
        let at = |u, v| by_uv(&Hit { t: 1.0, u, v, primitive: 0 });
        assert_eq!([at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)], [[255, 0, 0], [0, 255, 0], [0, 0, 255]]);
        assert_eq!(by_uv(&Hit::MISS), BACKGROUND);
    }
}
