//! Family 40: rays on both sides of the exact bound, one ulp apart, for filters to get wrong.
//!
//! All numbers are whole multiples of 2^-21 below 8, so the signs of the discriminant (102 bits) and of the edge
//! functions (80 bits) are exact in `i128`; a bisection then finds the two neighbours between which they flip.

use glam::{DVec3, Vec3};
use rayproof_scene::{Geometry, Mesh, Ray, Scene, Sphere, Triangle};

use super::Case;
use super::aim::{round, soup, turned, turned_triangle, within};
use super::draw::Draw;

/// How many units make 1.
const ONE: f64 = 2_097_152.0;

/// A point or a direction in units.
type Whole = [i128; 3];

/// What a line may or may not meet.
enum Shape {
    Sphere(Whole, i128),
    Triangle([Whole; 3]),
}

/// 40: origins an ulp inside and an ulp outside of the limb of a sphere or an edge of a triangle; `t_max` at the hit.
pub(super) fn margins(draw: &mut Draw, variant: usize, rays: usize) -> Case {
    let shape = if variant == 0 { sphere(draw) } else { triangle(draw) };
    let (turn, scale) = (draw.turn(), draw.power(-40, 40) / ONE);
    let point = |p: Whole| turn.apply(real(p, scale));
    let geometry = match &shape {
        Shape::Sphere(center, radius) => {
            let radius = real([*radius, 0, 0], scale).x;
            Geometry::Spheres(vec![Sphere { center: point(*center), radius }])
        }
        Shape::Triangle(corners) => {
            let [a, b, c] = corners.map(|p| real(p, scale));
            Geometry::Mesh(soup(&[turned_triangle(turn, Triangle { a, b, c })]))
        }
    };
    let rays = (0..rays)
        .map(|_| {
            let (origin, direction) = pair(draw, &shape);
            let ray = Ray::new(real(origin, scale), real(direction, scale));
            let t = round(middle_of(&shape, origin, direction));
            let t_max = draw.pick(&[f32::INFINITY, f32::INFINITY, t, t.next_up(), t.next_down()]);
            within(turned(turn, ray), 0.0, t_max)
        })
        .collect();
    Case { scene: Scene::new(vec![geometry]).expect("made of finite numbers"), rays }
}

/// Units to coordinates: 24 bits or fewer, so nothing is rounded.
fn real(p: Whole, scale: f64) -> Vec3 {
    DVec3::from_array(p.map(|x| x as f64 * scale)).as_vec3()
}

#[expect(clippy::cast_possible_truncation, reason = "below 2^24 by construction, and rounded on purpose")]
fn units(x: f64) -> i128 {
    (x * ONE).round() as i128
}

fn sphere(draw: &mut Draw) -> Shape {
    let center = [draw.range(1.0, 3.0), draw.range(5.0, 6.0), draw.range(-1.0, 1.0)].map(units);
    Shape::Sphere(center, units(draw.log(0.05, 0.5)))
}

fn triangle(draw: &mut Draw) -> Shape {
    let mut corner = || [draw.range(1.0, 3.0), draw.range(5.2, 6.2), draw.range(-1.0, 1.0)].map(units);
    Shape::Triangle([corner(), corner(), corner()])
}

/// An origin and a direction: the line meets the shape, and misses it when the origin moves one unit along y; or the
/// other of those two. y is in 4..8, where a unit is an ulp.
fn pair(draw: &mut Draw, shape: &Shape) -> (Whole, Whole) {
    loop {
        let target = match shape {
            Shape::Sphere(c, r) => real(*c, 1.0).as_dvec3() + draw.unit() * draw.range(0.0, 0.8) * (*r as f64),
            Shape::Triangle(corners) => {
                super::aim::point_of(draw, &mesh_of(corners)) * 0.9
                    + corners.iter().map(|c| real(*c, 1.0).as_dvec3()).sum::<DVec3>() * (0.1 / 3.0)
            }
        } / ONE;
        let slopes = [1.0, draw.range(-0.1, 0.1), draw.range(-0.3, 0.3)];
        let direction = DVec3::from_array(slopes) * draw.range(0.5, 3.0);
        let start = target - direction / direction.x * (target.x + draw.range(0.5, 4.0));
        let direction = direction.to_array().map(units);
        let start = start.to_array().map(units);
        let at = |y: i128| [start[0], y, start[2]];
        let (mut hit, mut miss) = (start[1], start[1] + units(draw.sign() * 1.15));
        let inside = |y: i128| (4 << 21..8 << 21).contains(&y);
        if !inside(hit) || !inside(miss) || !meets(shape, at(hit), direction) || meets(shape, at(miss), direction) {
            continue;
        }
        while (hit - miss).abs() > 1 {
            let y = i128::midpoint(hit, miss);
            *if meets(shape, at(y), direction) { &mut hit } else { &mut miss } = y;
        }
        return (at(if draw.chance(0.5) { hit } else { miss }), direction);
    }
}

fn mesh_of(corners: &[Whole; 3]) -> Mesh {
    let [a, b, c] = corners.map(|p| real(p, 1.0));
    soup(&[Triangle { a, b, c }])
}

fn minus(a: Whole, b: Whole) -> Whole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Whole, b: Whole) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Whole, b: Whole) -> Whole {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whether the whole line meets the closed shape, exactly.
fn meets(shape: &Shape, origin: Whole, direction: Whole) -> bool {
    match shape {
        Shape::Sphere(center, radius) => {
            let o = minus(origin, *center);
            let b = dot(o, direction);
            b * b >= dot(direction, direction) * (dot(o, o) - radius * radius)
        }
        Shape::Triangle(corners) => {
            let [a, b, c] = corners.map(|p| minus(p, origin));
            let sides = [(b, c), (c, a), (a, b)].map(|(p, q)| dot(direction, cross(p, q)));
            sides.iter().sum::<i128>() != 0 && (sides.iter().all(|s| *s >= 0) || sides.iter().all(|s| *s <= 0))
        }
    }
}

/// The t of the triangle's plane, or of the point of the line next to the sphere's centre, to double precision.
fn middle_of(shape: &Shape, origin: Whole, direction: Whole) -> f64 {
    match shape {
        Shape::Sphere(center, _) => dot(minus(*center, origin), direction) as f64 / dot(direction, direction) as f64,
        Shape::Triangle([a, b, c]) => {
            let normal = cross(minus(*b, *a), minus(*c, *a));
            dot(minus(*a, origin), normal) as f64 / dot(direction, normal) as f64
        }
    }
}
