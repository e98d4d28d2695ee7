//! Single precision keeps the promise, and uses a fair part of it.

use rayproof_scene::{Geometry, Ray, Scene};

use super::{Random, fast, hard_sphere, hard_triangle, mesh, sphere_scene, triangle_scene};
use crate::{
    Oracle,
    judge::{Verdict, judge_any, judge_closest, judge_count},
};

#[derive(Default, Debug)]
struct Tally {
    rays: usize,
    exact_hits: usize,
    forgiven: usize,
    worst: f64,
}

impl Tally {
    fn judge(&mut self, scene: &Scene, ray: &Ray) {
        let (oracle, hits) = (Oracle::new(scene), fast::hits(scene, ray));
        let answer = fast::closest(scene, ray);
        let verdict = judge_closest(&oracle, ray, &answer);
        assert!(verdict.is_accepted(), "{verdict}{scene:?}");
        let any = judge_any(&oracle, ray, u8::from(!hits.is_empty()));
        assert!(any.is_accepted(), "{any}{scene:?}");
        self.rays += 1;
        match verdict {
            Verdict::Exact(errors) if answer.is_hit() => {
                self.exact_hits += 1;
                self.worst = self.worst.max(errors.of_promise);
            }
            Verdict::WithinPromise(_) => self.forgiven += 1,
            _ => {}
        }
    }

    fn report(&self, name: &str) {
        println!("{name}: {self:?}");
        assert!(self.exact_hits > self.rays / 10, "too few hits to say anything");
        assert!(self.forgiven > 0, "no case was marginal");
        assert!(self.worst > 0.1, "the bound is far from what rounding does");
    }
}

#[test]
fn on_hard_triangles() {
    let (mut random, mut tally) = (Random::new(0x5eed_0030), Tally::default());
    for _ in 0..60_000 {
        let (triangle, ray) = hard_triangle(&mut random);
        tally.judge(&triangle_scene(&[triangle]), &ray);
    }
    tally.report("triangles");
}

#[test]
fn on_hard_spheres() {
    let (mut random, mut tally) = (Random::new(0x5eed_0031), Tally::default());
    for _ in 0..60_000 {
        let (sphere, ray) = hard_sphere(&mut random);
        tally.judge(&sphere_scene(&[sphere]), &ray);
    }
    tally.report("spheres");
}

/// Near ties between primitives: a scene of near copies, in both kinds.
#[test]
fn on_crowds() {
    let (mut random, mut tally) = (Random::new(0x5eed_0032), Tally::default());
    for _ in 0..6_000 {
        let (triangle, ray) = hard_triangle(&mut random);
        let (sphere, other) = hard_sphere(&mut random);
        let mut shifted = || {
            let mut moved = triangle;
            moved.b = moved.b.lerp(moved.a, random.scale(-8.0, -1.0));
            moved.c += (moved.a - moved.c) * random.scale(-8.0, -1.0);
            moved
        };
        let triangles = [triangle, shifted(), shifted(), triangle];
        let mut grown = || {
            let mut grown = sphere;
            grown.radius *= 1.0 + random.scale(-8.0, -1.0);
            grown
        };
        let spheres = vec![sphere, grown(), grown()];
        let scene = Scene::new(vec![mesh(&triangles), Geometry::Spheres(spheres)]).expect("a valid scene");
        for ray in [ray, other] {
            tally.judge(&scene, &ray);
        }
    }
    tally.report("crowds");
}

#[test]
fn counts_of_triangles() {
    let mut random = Random::new(0x5eed_0033);
    let (mut equal, mut forgiven) = (0, 0);
    for _ in 0..5_000 {
        let (triangle, ray) = hard_triangle(&mut random);
        let scene = triangle_scene(&[triangle, triangle]);
        let count = u32::try_from(fast::hits(&scene, &ray).len()).unwrap();
        match judge_count(&Oracle::new(&scene), &ray, count) {
            Verdict::Exact(_) => equal += 1,
            Verdict::WithinPromise(_) => forgiven += 1,
            wrong @ Verdict::Disagrees(..) => panic!("{wrong}"),
        }
    }
    println!("{equal} counts equal, {forgiven} forgiven");
    assert!(equal > 2_000 && forgiven > 0);
}
