use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use rayproof_scene::random::Random;
use rayproof_scene::{Camera, Ray, Scene};

use super::finite;

/// Rays from random points of the sphere around a scene's box to random points of the box, as many as are wanted.
#[derive(Clone, Copy, Debug)]
pub struct Incoherent {
    low: DVec3,
    high: DVec3,
    seed: u64,
}

impl Incoherent {
    /// Rays across what [`Camera::framing`] frames of a scene.
    #[must_use]
    pub fn new(scene: &Scene, seed: u64) -> Self {
        let [low, high] = framed(scene);
        Self { low, high, seed }
    }

    /// Ray `i`; its direction has unit length.
    #[must_use]
    pub fn ray(&self, i: u64) -> Ray {
        crossing(self.low, self.high, &mut Random::new(self.seed, i))
    }

    /// The rays of these numbers, made by all threads.
    #[must_use]
    pub fn rays(&self, numbers: Range<u64>) -> Vec<Ray> {
        numbers.into_par_iter().map(|i| self.ray(i)).collect()
    }
}

/// The part of the scene's box that [`Camera::framing`] frames: a ground sphere does not draw all rays to itself.
fn framed(scene: &Scene) -> [DVec3; 2] {
    let camera = Camera::framing(scene);
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    // The camera stands where the sphere around the framed box just fits into its view.
    let half = DVec3::splat((eye - target).length() * (f64::from(camera.fov_y).to_radians() * 0.5).sin());
    let [low, high] = scene.bounds().unwrap_or([Vec3::NEG_ONE, Vec3::ONE]).map(|corner| corner.as_dvec3());
    [low.max(target - half), high.min(target + half)]
}

/// A ray from a point of the sphere around a box to a point of the box; the direction has unit length.
fn crossing(low: DVec3, high: DVec3, random: &mut Random) -> Ray {
    let half = (high - low) * 0.5;
    let center = low + half;
    let outward = random.on_sphere();
    let origin = outward * half.length().max(f64::from(f32::MIN_POSITIVE));
    let target = (random.in_cube() * 2.0 - 1.0) * half;
    Ray::new(finite(center + origin), (target - origin).try_normalize().unwrap_or(-outward).as_vec3())
}

#[cfg(test)]
mod tests {
    use rayproof_scene::{Geometry, Sphere};

    use super::*;

    #[test]
    fn crossing_rays_start_on_the_sphere_and_pass_through_the_box() {
        let (low, high) = (DVec3::new(-1.0, 2.0, 3.0), DVec3::new(1.0, 3.0, 7.0));
        let (center, half) = ((low + high) * 0.5, (high - low) * 0.5);
        for i in 0..1000 {
            let ray = crossing(low, high, &mut Random::new(5, i));
            let (o, d) = (ray.origin.as_dvec3() - center, ray.direction.as_dvec3());
            assert!((o.length() - half.length()).abs() < 1e-6, "{ray:?}");
            // Slabs: the ray is inside all three at the same time somewhere.
            let (a, b) = ((-half - o) / d, (half - o) / d);
            assert!(a.min(b).max_element() <= a.max(b).min_element(), "{ray:?}");
        }
    }

    #[test]
    fn a_ground_sphere_does_not_draw_all_rays_to_itself() {
        let ball = Sphere { center: Vec3::new(0.0, 1.0, 0.0), radius: 1.0 };
        let ground = Sphere { center: Vec3::new(0.0, -1e6, 0.0), radius: 1e6 };
        let scene =
            |spheres: &[Sphere]| Scene::new(vec![Geometry::Spheres(spheres.to_vec())]).expect("made of finite numbers");
        let [low, high] = framed(&scene(&[ball]));
        assert!((low - DVec3::new(-1.0, 0.0, -1.0)).length() < 1e-6, "{low}");
        assert!((high - DVec3::new(1.0, 2.0, 1.0)).length() < 1e-6, "{high}");
        let [low, high] = framed(&scene(&[ball, ground]));
        assert!((high - low).max_element() < 4.0, "{low} {high}");
    }

    #[test]
    fn a_scene_of_one_point_still_has_rays() {
        let point = DVec3::splat(1e6);
        for i in 0..100 {
            assert_eq!(crossing(point, point, &mut Random::new(5, i)).fault(), None);
        }
        let huge = DVec3::splat(f64::from(f32::MAX));
        for i in 0..100 {
            assert_eq!(crossing(-huge, huge, &mut Random::new(5, i)).fault(), None);
        }
    }
}
