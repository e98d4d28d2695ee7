use rayproof_scene::normal::{facing, normal};
use rayproof_scene::random::Random;
use rayproof_scene::{Hit, Ray, Scene};

use super::finite;

/// How far the origin is pushed off the surface, against meeting it again at once: so many times the distance from
/// the eye or the largest coordinate of the point, whichever is larger. 256 times the rounding of an f32.
const PUSH: f64 = 1.0 / 65536.0;

/// The ray from where `ray` hits, in a cosine-weighted random direction about the geometric normal that faces the
/// viewer.
pub(super) fn bounce(scene: &Scene, ray: &Ray, hit: &Hit, random: &mut Random) -> Ray {
    let d = ray.direction.as_dvec3();
    let along = d * f64::from(hit.t);
    let p = ray.origin.as_dvec3() + along;
    let normal = facing(normal(scene, &scene.flat_hit(hit), p), d);
    let push = PUSH * along.length().max(p.abs().max_element());
    // A unit normal plus a uniform point of the unit sphere is cosine-weighted (Lambert's law).
    let direction = (normal + random.on_sphere()).try_normalize().unwrap_or(normal);
    Ray::new(finite(p + normal * push), direction.as_vec3())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use rayproof_scene::{Geometry, Mesh, Sphere};

    use super::*;

    #[test]
    fn bounces_leave_on_the_viewers_side_with_the_cosine() {
        let square = Mesh { vertices: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]] };
        let spheres = vec![Sphere { center: Vec3::new(5.0, 0.0, -1.0), radius: 1.0 }];
        let scene =
            Scene::new(vec![Geometry::Mesh(square), Geometry::Spheres(spheres)]).expect("made of finite numbers");
        for (x, geometry, side) in [(0.25, 0, 1.0), (0.25, 0, -1.0), (5.0, 1, 1.0)] {
            let ray = Ray::new(Vec3::new(x, 0.0, side * 4.0), Vec3::new(0.0, 0.0, -side));
            let hit = Hit { t: 4.0, u: 0.25, v: 0.0, geometry, primitive: 0 };
            let n = 20_000;
            let mut cosines = 0.0;
            for i in 0..n {
                let out = bounce(&scene, &ray, &hit, &mut Random::new(3, i));
                assert!(out.fault().is_none());
                assert_eq!(out.origin.truncate(), ray.origin.truncate());
                assert!(out.origin.z * side > 0.0 && out.origin.z.abs() < 1e-3, "{out:?}");
                assert!((out.direction.length() - 1.0).abs() < 1e-6);
                assert!(out.direction.z * side >= 0.0);
                cosines += f64::from(out.direction.z * side);
            }
            // The mean cosine of a cosine-weighted direction is 2/3, its deviation 0.2357.
            let mean = cosines / n as f64;
            assert!((mean - 2.0 / 3.0).abs() < 5.0 * 0.2357 / (n as f64).sqrt(), "{mean}");
        }
    }
}
