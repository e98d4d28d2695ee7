//! The hard cases, as scenes to step through.

use std::sync::Arc;

use glam::DVec3;
use rayproof::scene::{Camera, FlatHit, Primitive, Ray, Scene};
use rayproof::{Device, Error, Precision};
use rayproof_oracle::families::{self, Family};

use super::world::World;

/// What all draws of the gallery start from.
const SEED: u64 = 5;
/// Rays over all scenes of a family.
const RAYS: usize = 256;

/// A scene of a family, with the rays that are aimed at it.
pub(crate) struct Exhibit {
    pub(crate) world: Arc<World>,
    /// The family's place in the list of all.
    pub(crate) family: usize,
    /// The scene's place among the family's.
    pub(crate) number: usize,
    /// How many scenes the family has here.
    pub(crate) of: usize,
    pub(crate) rays: Vec<Answered>,
}

/// A ray of an exhibit, and every precision's answer.
#[derive(Clone)]
pub(crate) struct Answered {
    pub(crate) ray: Ray,
    /// In the order of [`Precision::ALL`]; the last is exact.
    pub(crate) hits: [FlatHit; 6],
}

/// The families, by their numbers.
pub(crate) fn all() -> &'static [Family] {
    families::all()
}

impl Exhibit {
    /// Opens a scene of a family; the last one there is for a number that is too high.
    ///
    /// # Errors
    /// When an engine fails.
    pub(crate) fn open(family: usize, number: usize, device: Device) -> Result<Self, Error> {
        let hung = &all()[family.min(all().len() - 1)];
        let mut cases = hung.cases(SEED, RAYS);
        let of = cases.len();
        let number = number.min(of.saturating_sub(1));
        let case = cases.swap_remove(number);
        let name = format!("family {}, {}: scene {} of {of}", hung.number, hung.name, number + 1);
        let camera = case.rays.first().and_then(|first| seen_from(&case.scene, &case.rays, first));
        let world = Arc::new(World::new(name, case.scene, camera, device));
        let mut answers = vec![[FlatHit::MISS; 6]; case.rays.len()];
        for (place, precision) in Precision::ALL.into_iter().enumerate() {
            let mut hits = vec![FlatHit::MISS; case.rays.len()];
            world.on_cpu(precision)?.closest_flat(&case.rays, &mut hits)?;
            answers.iter_mut().zip(hits).for_each(|(all, hit)| all[place] = hit);
        }
        let rays = case.rays.into_iter().zip(answers).map(|(ray, hits)| Answered { ray, hits }).collect();
        Ok(Self { world, family, number, of, rays })
    }
}

/// A camera that stands where the first ray starts, and sees what the rays are aimed at as large as can be.
fn seen_from(scene: &Scene, rays: &[Ray], first: &Ray) -> Option<Camera> {
    let oracle = rayproof_oracle::Oracle::new(scene);
    let hit = rays.iter().take(32).find_map(|ray| oracle.closest(ray)).map(|hit| hit.primitive as usize);
    let aim = scene.primitive(hit.unwrap_or(0).min(scene.len().checked_sub(1)?));
    let (center, radius) = match aim {
        Primitive::Sphere(s) => (s.center.as_dvec3(), f64::from(s.radius)),
        Primitive::Triangle(t) => {
            let corners = [t.a, t.b, t.c].map(|v| v.as_dvec3());
            let center = corners.iter().sum::<DVec3>() / 3.0;
            (center, corners.iter().map(|c| c.distance(center)).fold(0.0, f64::max))
        }
    };
    let eye = first.origin.as_dvec3();
    let distance = eye.distance(center);
    // From on or in the primitive, or next to it, it fills the view.
    let near = distance <= radius * 1.05;
    let target = if near { eye + first.direction.as_dvec3().normalize() * radius.max(1e-30) } else { center };
    let half = if near { 30.0_f64.to_radians() } else { (1.25 * (radius / distance).min(1.0).asin()).clamp(1e-9, 1.0) };
    let sight = (target - eye).normalize_or_zero();
    let up = if sight.y.abs() < 0.9 { glam::Vec3::Y } else { glam::Vec3::Z };
    #[expect(clippy::cast_possible_truncation, reason = "degrees")]
    let fov_y = (2.0 * half).to_degrees() as f32;
    let camera = Camera { eye: first.origin, target: target.as_vec3(), up, fov_y };
    camera.fault().is_none().then_some(camera)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn every_family_hangs_with_its_rays_answered() {
        let mut hits = 0;
        for family in 0..all().len() {
            let exhibit = Exhibit::open(family, 0, Device::cpu()).unwrap();
            assert!(exhibit.of > 0 && !exhibit.rays.is_empty(), "{}", exhibit.world.name);
            assert_eq!(exhibit.world.camera.fault(), None, "{}", exhibit.world.name);
            hits += exhibit.rays.iter().filter(|ray| ray.hits[5].is_hit()).count();
            let last = Exhibit::open(family, usize::MAX, Device::cpu()).unwrap();
            assert_eq!(last.number + 1, exhibit.of);
        }
        assert!(hits > 1000, "{hits}");
    }
}
