use std::fmt;

use rayproof_scene::{FlatHit, Primitive, Ray, Scene};

/// An answer to one ray, of any query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// To the query `closest`, with the hit's `(geometry, primitive)` where the scene has it.
    Closest(FlatHit, Option<(usize, usize)>),
    /// To the query `any`: 0 or 1.
    Any(u8),
    /// To the query `count`.
    Count(u32),
}

impl Answer {
    pub(crate) fn closest(scene: &Scene, hit: FlatHit) -> Self {
        let flat = hit.primitive as usize;
        Self::Closest(hit, (flat < scene.len()).then(|| scene.locate(flat)))
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Closest(hit, place) => {
                write!(f, "{}", show_hit(hit))?;
                place.map_or(Ok(()), |(geometry, primitive)| write!(f, " (geometry {geometry}, primitive {primitive})"))
            }
            Self::Any(hit) => write!(f, "any {hit}"),
            Self::Count(count) => write!(f, "count {count}"),
        }
    }
}

/// One ray with the exact answer and the one judged. It displays as a block of lines that gives every number as its
/// bits and as the shortest decimal that reads back to them.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedRay {
    /// The ray.
    pub ray: Ray,
    /// The exact answer, its numbers rounded to the nearest.
    pub exact: Answer,
    /// The answer judged.
    pub answer: Answer,
    /// What is left of the primitive's equation at the point that the answer claims, in `f64`: `|f(p)| / r^2` of a sphere,
    /// the distance to `a + u (b - a) + v (c - a)` of a triangle; `None` where it claims no hit.
    pub residual: Option<f64>,
}

/// What is left of the primitive's own equation at the answer's point `p = e + t d`, in `f64`: `|f(p)| / r^2` of a sphere's
/// implicit function `f(p) = (p - c).(p - c) - r^2`, or the distance of `p` from the triangle's `a + u (b - a) + v (c - a)`.
pub(super) fn residual(scene: &Scene, ray: &Ray, hit: &FlatHit) -> Option<f64> {
    let flat = hit.primitive as usize;
    if flat >= scene.len() {
        return None;
    }
    let p = ray.origin.as_dvec3() + ray.direction.as_dvec3() * f64::from(hit.t);
    Some(match scene.primitive(flat) {
        Primitive::Sphere(sphere) => {
            let o = p - sphere.center.as_dvec3();
            let r = f64::from(sphere.radius);
            (o.dot(o) - r * r).abs() / (r * r)
        }
        Primitive::Triangle(t) => {
            let [a, b, c] = [t.a, t.b, t.c].map(|v| v.as_dvec3());
            p.distance(a + (b - a) * f64::from(hit.u) + (c - a) * f64::from(hit.v))
        }
    })
}

impl fmt::Display for JudgedRay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { ray, exact, answer, residual } = self;
        let show = |numbers: &[f32]| numbers.iter().map(|&x| bits(x)).collect::<Vec<_>>().join("  ");
        writeln!(f, "  origin     {}", show(&ray.origin.to_array()))?;
        writeln!(f, "  direction  {}", show(&ray.direction.to_array()))?;
        writeln!(f, "  range      {}", show(&[ray.t_min, ray.t_max]))?;
        writeln!(f, "  exact      {exact}")?;
        writeln!(f, "  answer     {answer}")?;
        residual.map_or(Ok(()), |residual| writeln!(f, "  residual   {residual:.3e}"))
    }
}

/// Why an answer is wrong.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A NaN.
    #[error("t, u or v is not a number")]
    NotANumber,
    /// A miss that does not read as one.
    #[error("a miss is t = inf, u = v = 0")]
    MalformedMiss,
    /// A primitive that the scene does not have.
    #[error("the scene has no such primitive")]
    NoSuchPrimitive,
    /// Neither 0 nor 1.
    #[error("any is 0 or 1")]
    NotAFlag,
    /// A `t` before `t_min` or after `t_max`.
    #[error("t is outside the ray's range")]
    OutOfRange,
    /// Weights that no point of the primitive has.
    #[error("u, v is no point of the primitive")]
    OutsidePrimitive,
    /// The right primitive at another place.
    #[error("t, u or v is off by {0:.3e} times what single precision allows")]
    WrongNumbers(f64),
    /// A primitive that is not there.
    #[error("the ray does not hit that primitive there: off by {0:.3e} times what single precision allows")]
    FalseHit(f64),
    /// A hit that is plain in single precision, and nearer than the answer.
    #[error("a clear hit was passed over: primitive {primitive} at t = {t:?}")]
    PassedOver {
        /// The flat number of the primitive.
        primitive: u32,
        /// Where the ray hits it, rounded.
        t: f32,
    },
    /// A flag or a count that no single-precision evaluation gives.
    #[error("nothing close to the ray accounts for the answer")]
    Unaccounted,
}

/// A number as its bits and as the shortest decimal that reads back to them.
pub(super) fn bits(x: f32) -> String {
    format!("{:#010x} {x:?}", x.to_bits())
}

/// A hit in one line.
pub(super) fn show_hit(hit: &FlatHit) -> String {
    let FlatHit { t, u, v, primitive } = *hit;
    let id = if hit.is_hit() { format!("hit {primitive}") } else { "miss".to_owned() };
    format!("{id}  t {}  u {}  v {}", bits(t), bits(u), bits(v))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use rayproof_scene::{Geometry, Mesh, Sphere};

    use super::*;

    #[test]
    fn residuals_are_what_is_left_of_the_equations() {
        let vertices = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let mesh = Mesh { vertices, triangles: vec![[0, 1, 2]] };
        let ball = Sphere { center: Vec3::ZERO, radius: 5.0 };
        let scene = Scene::new(vec![Geometry::Mesh(mesh), Geometry::Spheres(vec![ball])]).expect("a valid scene");
        let ray = Ray::new(Vec3::new(0.25, 0.5, -13.0), Vec3::Z);
        let triangle = |t: f32| residual(&scene, &ray, &FlatHit { t, u: 0.25, v: 0.5, primitive: 0 });
        assert_eq!((triangle(13.0), triangle(12.5)), (Some(0.0), Some(0.5)));
        let axis = Ray::new(Vec3::new(0.0, 0.0, -13.0), Vec3::Z);
        let sphere = |t: f32| residual(&scene, &axis, &FlatHit { t, u: 0.0, v: 0.0, primitive: 1 });
        assert_eq!((sphere(8.0), sphere(9.0)), (Some(0.0), Some(0.36)));
        assert_eq!(residual(&scene, &ray, &FlatHit::MISS), None);
    }
}
