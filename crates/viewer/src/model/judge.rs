//! The oracle, pixel after pixel: it owes nothing to the engines, and takes its time.

use std::time::Instant;

use rayon::prelude::*;
use rayproof::scene::{FlatHit, Pixels, Ray, Scene};
use rayproof_oracle::Oracle;

use super::layer::{STEPS, row_of_pass};

/// How far the oracle is with a picture.
#[derive(Default)]
pub(crate) struct Judge {
    /// The pixels in the order in which they are judged: coarse first.
    order: Vec<u32>,
    judged: usize,
    contradicted: usize,
    /// Pixels a call: as many as take some hundredths of a second.
    chunk: usize,
}

impl Judge {
    /// How many pixels are judged.
    pub(crate) const fn judged(&self) -> usize {
        self.judged
    }

    /// For how many the oracle had another answer.
    pub(crate) const fn contradicted(&self) -> usize {
        self.contradicted
    }

    /// Judges some more pixels; where the oracle has another answer than `exact`, it takes the place of that. Returned is
    /// whether there are more.
    pub(crate) fn go_on(&mut self, scene: &Scene, pixels: Pixels, size: [u32; 2], exact: &mut [FlatHit]) -> bool {
        if self.order.is_empty() {
            self.order = order(size);
            self.chunk = 64;
        }
        let start = Instant::now();
        let places = &self.order[self.judged..self.order.len().min(self.judged + self.chunk)];
        let oracle = Oracle::new(scene);
        let ray = |place: u32| -> Ray { pixels.ray(place % size[0], place / size[0]) };
        let answer = |&place: &u32| oracle.hit(&ray(place));
        let answers: Vec<FlatHit> = places.par_iter().map(answer).collect();
        for (&place, answer) in places.iter().zip(&answers) {
            let known = &mut exact[place as usize];
            if !known.same_bits(answer) {
                self.contradicted += 1;
                *known = *answer;
            }
        }
        self.judged += answers.len();
        self.chunk = match start.elapsed().as_millis() {
            0..15 => (self.chunk * 2).min(1 << 16),
            15..40 => self.chunk,
            _ => (self.chunk / 2).max(4),
        };
        self.judged < self.order.len()
    }
}

/// All pixels, those of coarse passes first.
fn order([width, height]: [u32; 2]) -> Vec<u32> {
    let rows = (0..STEPS.len()).flat_map(|pass| (0..height).step_by(STEPS[pass] as usize).map(move |y| (pass, y)));
    rows.flat_map(|(pass, y)| row_of_pass(pass, pass == 0, y, width).map(move |x| y * width + x)).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use rayproof::scene::{Camera, Geometry, Sphere};

    use super::*;

    #[test]
    fn every_pixel_is_judged_and_a_wrong_answer_is_replaced() {
        let scene = Scene::new(vec![Geometry::Spheres(vec![Sphere { center: Vec3::ZERO, radius: 1.0 }])])
            .expect("made of finite numbers");
        let size = [20, 13];
        let pixels = Camera::framing(&scene).pixels(20, 13);
        let rays = (0..13).flat_map(|y| (0..20).map(move |x| pixels.ray(x, y)));
        let truth: Vec<FlatHit> = rays.map(|ray| Oracle::new(&scene).hit(&ray)).collect();
        let mut exact = truth.clone();
        let hit = exact.iter().position(FlatHit::is_hit).unwrap_or(0);
        exact[hit].t = f32::from_bits(exact[hit].t.to_bits() + 1);
        let miss = exact.iter().position(|hit| !hit.is_hit()).unwrap_or(0);
        exact[miss] = exact[hit];
        let mut judge = Judge::default();
        while judge.go_on(&scene, pixels, size, &mut exact) {}
        assert_eq!((judge.judged(), judge.contradicted()), (260, 2));
        assert_eq!(exact, truth);
    }
}
