//! Families 11 to 15: directions, origins and radii at the ends of the exponent range.

use glam::{DVec3, Vec3};
use rayproof_scene::{Ray, Sphere};

use super::Case;
use super::aim::{along, on_sphere, passing, passing_exactly, round, turned};
use super::draw::{Draw, one_of};

/// The smallest positive `f32`, a subnormal.
const TINY: f32 = f32::from_bits(1);

/// 11: directions of length 1e-10 down to the smallest subnormal: `d.d` underflows.
pub(super) fn short_direction(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e-10, 1e-15, 1e-19, 1e-20, 1e-22, 1e-30, 0.0][variant];
    let center = (draw.unit() * draw.pick(&[0.0, 1.0])).as_vec3();
    on_sphere(Sphere { center, radius: 1.0 }, rays, || {
        let impact = if draw.chance(0.5) { draw.range(0.0, 1.1) } else { 1.0 + draw.sign() * draw.log(1e-6, 1e-1) };
        if nominal > 0.0 {
            let (distance, length) = (draw.around(10.0, 0.3), draw.around(nominal, 0.5));
            return passing(draw, center, distance, impact, length);
        }
        // Whole multiples of the smallest subnormal, aimed by moving the origin: few of them, or many.
        let most = draw.pick(&[1, 3, 30, 4_000_000]);
        let whole = draw.wholes(-most, most);
        let whole = if whole == DVec3::ZERO { DVec3::X } else { whole };
        let forward = whole.normalize();
        let origin = center.as_dvec3() - forward * draw.around(10.0, 0.3) + draw.across(forward) * impact;
        along(origin.as_vec3(), whole * f64::from(TINY))
    })
}

/// 12: directions of length 1e10 up to the largest finite value: `d.d` and `b^2` overflow.
pub(super) fn long_direction(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e10, 1e18, 1e19, 1e20, 3e38][variant];
    let center = (draw.unit() * draw.pick(&[0.0, 1.0])).as_vec3();
    on_sphere(Sphere { center, radius: 1.0 }, rays, || {
        let impact = if draw.chance(0.5) { draw.range(0.0, 1.1) } else { 1.0 + draw.sign() * draw.log(1e-6, 1e-1) };
        let distance = draw.around(10.0, 0.3);
        let length = nominal * draw.log(0.3, 1.1);
        passing(draw, center, distance, impact, length)
    })
}

/// 13: the valid neighbours of a zero direction: one subnormal component, the others zeros of both signs.
pub(super) fn almost_no_direction(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let size = [1.0, 1e-30, 1e-38, 1e-40][variant];
    on_sphere(Sphere { center: Vec3::ZERO, radius: round(size) }, rays, || {
        let zeros = [draw.pick(&[0.0, -0.0]), draw.pick(&[0.0, -0.0])];
        let step = draw.pick(&[TINY, 2.0 * TINY, 1e-40, f32::MIN_POSITIVE.next_down(), f32::MIN_POSITIVE]);
        let origin = DVec3::new(-3.0, one_of([0.0, draw.range(-2.0, 2.0), 1.0], draw), 0.0) * size;
        turned(draw.turn(), Ray::new(origin.as_vec3(), Vec3::new(step, zeros[0], zeros[1])))
    })
}

/// 14: centres, radii and origins of 1e19 to 3e38: `o.o` overflows, and at last the box of the sphere.
pub(super) fn huge(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let nominal = [1e19, 1e20, 1e25, 1e30, 1e38][variant];
    let center = (draw.unit() * nominal * draw.log(0.3, 1.0)).as_vec3();
    let radius = round(nominal * draw.log(0.1, 1.0));
    on_sphere(Sphere { center, radius }, rays, || {
        let r = f64::from(radius);
        let impact = r * if draw.chance(0.5) { draw.range(0.0, 1.1) } else { 1.0 + draw.sign() * draw.log(1e-6, 1e-1) };
        // From inside, from near the surface, and from two radii away: below 3.4e38 even at the last.
        let distance = r * one_of([draw.range(0.1, 0.9), 1.0 + draw.log(1e-6, 1e-1), draw.range(1.2, 2.3)], draw);
        let length = one_of([1.0, draw.length(), r], draw);
        passing(draw, center, distance, impact, length)
    })
}

/// 15: radii below an ulp of the centre, subnormal, zero and minus zero, aimed through the very centre and beside it.
pub(super) fn speck(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let (radius, at) =
        [(1e-6, 1.0), (1e-6, 1e3), (1e-30, 0.0), (1e-40, 0.0), (0.0, 1.0), (0.0, 0.0), (-0.0, 1.0)][variant];
    let radius = round(if radius > 0.0 { draw.around(radius, 0.3) } else { radius });
    // A centre of few bits leaves room for e = c - m d to be exact.
    let center = draw.wholes(-255, 255) * (at / 256.0);
    // A point is missed by an ulp of its place.
    let reach = if radius > 0.0 { radius } else { round(at * (-23_f64).exp2()).max(1e-30) };
    on_sphere(Sphere { center: center.as_vec3(), radius }, rays, || {
        let beside = reach * round(one_of([0.0, 1.0, draw.range(0.0, 1.2), draw.log(1.0, 1e3)], draw));
        if draw.chance(0.5) {
            let distance = draw.log(1.0, 1e3) * if at > 0.0 { at } else { 1.0 };
            let ray = passing_exactly(draw, distance, beside, 0.0);
            return Ray { origin: (center + ray.origin.as_dvec3()).as_vec3(), ..ray };
        }
        let step = draw.wholes(-15, 15);
        let step = if step == DVec3::ZERO { DVec3::X } else { step };
        let unit = if at > 0.0 { at / 256.0 } else { 1.0 };
        let ray = along((center - step * unit * draw.whole(1, 100)).as_vec3(), step * draw.power(-3, 3));
        let nudge = turned(draw.turn(), Ray::new(Vec3::X * beside, Vec3::X)).origin;
        Ray { origin: (ray.origin.as_dvec3() + nudge.as_dvec3()).as_vec3(), ..ray }
    })
}
