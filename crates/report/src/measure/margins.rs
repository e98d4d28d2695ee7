//! Wrong verdicts against the distance of the line from the silhouette of a sphere or the edge of a triangle.
//!
//! A rounding moves a line by about the largest coordinate times `2^-24`: margins are in that unit. A precision whose wrong
//! verdicts stop at a margin of `m` answers rightly for some input within `m` roundings of the given one.

use glam::{DVec3, Vec3};
use rayproof::scene::{FlatHit, Geometry, Mesh, Ray, Scene, Sphere};
use rayproof_oracle::families::Draw;

use super::case::Asked;
use super::plan::Progress;
use super::statistics::rate;
use super::subject::Subject;
use super::truth::corners;
use super::{Error, Run};
use crate::model::{MarginCurve, MarginPoint};

/// The eye's distance from a primitive of size 1; it is the largest coordinate, within a rounding.
const DISTANCE: f64 = 10.0;

/// Bins: two an octave, from `2^LOWEST` on.
const LOWEST: i32 = -4;
const BINS: usize = 36;

pub(crate) fn measure(run: &mut Run<'_>, progress: &mut dyn Progress) -> Result<Vec<MarginCurve>, Error> {
    progress.stage("margins", 2);
    let mut curves = Vec::new();
    for (primitive, make) in [("sphere", spheres as fn(&mut Draw, usize) -> Margins), ("triangle", triangles)] {
        let Margins { scene, rays, margins } = make(&mut Draw::new(run.plan.seed, 102, 0), run.plan.margin);
        let asked = run.ask(scene, rays);
        for subject in run.bench.subjects_on(primitive == "sphere") {
            let hits = run.bench.closest(subject, &asked.scene, &asked.rays)?;
            curves.push(curve(primitive, subject, &asked, &hits, &margins));
        }
        progress.step();
    }
    Ok(curves)
}

/// Rays, and how far each passes from where the verdict turns.
struct Margins {
    scene: Scene,
    rays: Vec<Ray>,
    margins: Vec<f64>,
}

fn curve(primitive: &str, subject: Subject, asked: &Asked, hits: &[FlatHit], margins: &[f64]) -> MarginCurve {
    let mut bins = [(0_u64, 0_u64); BINS];
    let mut largest_wrong = 0.0_f64;
    for ((truth, hit), &margin) in asked.truth.iter().zip(hits).zip(margins) {
        let wrong = truth.hit.is_hit() != hit.is_hit();
        if wrong {
            largest_wrong = largest_wrong.max(margin);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the bins")]
        let bin = ((margin.log2() - f64::from(LOWEST)) * 2.0).floor().clamp(0.0, (BINS - 1) as f64) as usize;
        bins[bin].0 += u64::from(wrong);
        bins[bin].1 += 1;
    }
    let middle = |i: usize| (f64::from(LOWEST) + (i as f64 + 0.5) / 2.0).exp2();
    let filled = bins.iter().enumerate().filter(|(_, (_, of))| *of > 0);
    let points = filled.map(|(i, &(wrong, of))| MarginPoint { margin: middle(i), wrong: rate(wrong, of) }).collect();
    MarginCurve {
        primitive: primitive.to_owned(),
        precision: subject.id(),
        device: subject.device,
        points,
        largest_wrong,
    }
}

/// A margin in lengths, on either side, spread evenly over the bins.
fn aim(draw: &mut Draw) -> f64 {
    let size = draw.log(f64::from(LOWEST).exp2(), (f64::from(LOWEST) + BINS as f64 / 2.0).exp2());
    let side = if draw.chance(0.5) { 1.0 } else { -1.0 };
    side * size * unit()
}

fn unit() -> f64 {
    DISTANCE * 2.0_f64.powi(-24)
}

fn spheres(draw: &mut Draw, count: usize) -> Margins {
    let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])])
        .expect("made of finite numbers");
    let mut rays = Vec::with_capacity(count);
    let mut margins = Vec::with_capacity(count);
    for _ in 0..count {
        let away = draw.unit();
        let origin = (away * DISTANCE).as_vec3();
        // A line at `b` from the centre leaves the eye at the angle whose sine is b / distance.
        let sine = (1.0 + aim(draw)) / DISTANCE;
        let direction = -away * (1.0 - sine * sine).sqrt() + draw.across(away) * sine;
        let ray = Ray::new(origin, direction.as_vec3());
        let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        margins.push((o.cross(d).length() / d.length() - 1.0).abs() / unit());
        rays.push(ray);
    }
    Margins { scene, rays, margins }
}

fn triangles(draw: &mut Draw, count: usize) -> Margins {
    let corner = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / 3.0 + 0.3).sin_cos();
        DVec3::new(cos, sin * 0.8, sin * 0.6).as_vec3()
    };
    let mesh = Mesh { vertices: vec![corner(0), corner(1), corner(2)], triangles: vec![[0, 1, 2]] };
    let [a, b, c] = corners(&mesh.triangle(0));
    let edges = [(a, b), (b, c), (c, a)];
    let mut rays = Vec::with_capacity(count);
    let mut margins = Vec::with_capacity(count);
    for _ in 0..count {
        let (from, to) = edges[draw.below(3)];
        let normal = (b - a).cross(c - a).normalize();
        let outward = (to - from).normalize().cross(normal);
        let target = from.lerp(to, draw.range(0.05, 0.95)) + outward * aim(draw);
        // From anywhere on the front but at a grazing angle.
        let away = (normal + draw.unit() * 0.8).normalize();
        let origin = (target + away * DISTANCE).as_vec3();
        let ray = Ray::new(origin, (target - origin.as_dvec3()).normalize().as_vec3());
        let (e, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let apart = |(from, to): (DVec3, DVec3)| {
            let across = d.cross(to - from);
            (from - e).dot(across).abs() / across.length()
        };
        margins.push(edges.map(apart).into_iter().fold(f64::INFINITY, f64::min) / unit());
        rays.push(ray);
    }
    Margins { scene: Scene::new(vec![Geometry::Mesh(mesh)]).expect("made of finite numbers"), rays, margins }
}
