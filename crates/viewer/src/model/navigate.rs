//! Moves of a camera. Each gives a camera that sees, or the old one where there is none to be had in `f32`.

use glam::{DQuat, DVec3, Vec3};
use rayproof::scene::{Camera, Scene};

/// The camera's directions, and the distance from its eye to its target.
struct Frame {
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    distance: f64,
}

impl Frame {
    fn of(camera: &Camera) -> Self {
        let sight = camera.target.as_dvec3() - camera.eye.as_dvec3();
        let (forward, distance) = (sight.normalize(), sight.length());
        let right = forward.cross(camera.up.as_dvec3()).normalize();
        Self { forward, right, up: right.cross(forward), distance }
    }
}

/// A camera with another eye and target, if it sees.
fn moved(camera: &Camera, eye: DVec3, target: DVec3) -> Camera {
    let new = Camera { eye: eye.as_vec3(), target: target.as_vec3(), ..*camera };
    if new.fault().is_none() { new } else { *camera }
}

/// Turns the line of sight by angles in radians, to the right and up, but never over the poles.
fn turned(camera: &Camera, sight: DVec3, right: f64, up: f64) -> DVec3 {
    /// From the poles, in radians.
    const REST: f64 = 0.01;
    let pole = camera.up.as_dvec3().normalize();
    let height = pole.angle_between(sight);
    let lowered = (height - up).clamp(REST, std::f64::consts::PI - REST) - height;
    let side = sight.cross(pole).normalize();
    DQuat::from_axis_angle(pole, -right) * (DQuat::from_axis_angle(side, -lowered) * sight)
}

/// Around the target, the camera to the right and up, by angles in radians.
pub(crate) fn orbit(camera: &Camera, right: f64, up: f64) -> Camera {
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    moved(camera, target - turned(camera, target - eye, -right, -up), target)
}

/// Looks elsewhere, by angles in radians.
pub(crate) fn look(camera: &Camera, right: f64, up: f64) -> Camera {
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    moved(camera, eye, eye + turned(camera, target - eye, right, up))
}

/// Sideways, by shares of the picture's height at the target.
pub(crate) fn pan(camera: &Camera, right: f64, up: f64) -> Camera {
    let frame = Frame::of(camera);
    let height = 2.0 * frame.distance * (f64::from(camera.fov_y).to_radians() * 0.5).tan();
    let by = (frame.right * right + frame.up * up) * height;
    moved(camera, camera.eye.as_dvec3() + by, camera.target.as_dvec3() + by)
}

/// To the target or away from it: the distance is multiplied.
pub(crate) fn dolly(camera: &Camera, factor: f64) -> Camera {
    let (eye, target) = (camera.eye.as_dvec3(), camera.target.as_dvec3());
    moved(camera, target + (eye - target) * factor, target)
}

/// Where it looks, to the right and up, in multiples of the distance to the target.
pub(crate) fn fly(camera: &Camera, [right, up, forward]: [f64; 3]) -> Camera {
    let frame = Frame::of(camera);
    let by = (frame.right * right + frame.up * up + frame.forward * forward) * frame.distance;
    moved(camera, camera.eye.as_dvec3() + by, camera.target.as_dvec3() + by)
}

/// Makes a point the target, and looks at it.
pub(crate) fn focus(camera: &Camera, point: Vec3) -> Camera {
    moved(camera, camera.eye.as_dvec3(), point.as_dvec3())
}

/// Where a point is in a picture, in shares of its width and height from the upper left corner; none behind the eye.
pub(crate) fn project(camera: &Camera, [width, height]: [u32; 2], point: DVec3) -> Option<[f64; 2]> {
    let frame = Frame::of(camera);
    let to = point - camera.eye.as_dvec3();
    let ahead = to.dot(frame.forward);
    let half = (f64::from(camera.fov_y).to_radians() * 0.5).tan();
    let [x, y] = [frame.right, frame.up].map(|axis| to.dot(axis) / (ahead * half));
    let shape = f64::from(width) / f64::from(height);
    (ahead > 0.0).then(|| [0.5 + 0.5 * x / shape, 0.5 - 0.5 * y])
}

/// Zooms: the field of view is multiplied.
pub(crate) fn zoom(camera: &Camera, factor: f64) -> Camera {
    let half = (f64::from(camera.fov_y).to_radians() * 0.5).tan() * factor;
    #[expect(clippy::cast_possible_truncation, reason = "degrees")]
    let fov_y = (2.0 * half.atan().to_degrees()).min(150.0) as f32;
    let new = Camera { fov_y, ..*camera };
    if new.fault().is_none() { new } else { *camera }
}

/// From `10^decades` times twice the scene's radius, zoomed so that the scene keeps its size.
///
/// Seen along the axis that the camera looks along most: only there can directions in `f32` tell pixels apart from afar.
pub(crate) fn walk_away(camera: &Camera, scene: &Scene, decades: f64) -> Camera {
    let framing = Camera::framing(scene);
    let frame = Frame::of(&framing);
    let radius = frame.distance * (f64::from(framing.fov_y).to_radians() * 0.5).sin();
    let forward = Frame::of(camera).forward;
    let axis = forward.abs().max_position();
    let mut along = DVec3::ZERO;
    along[axis] = forward[axis].signum();
    let up = if along.cross(camera.up.as_dvec3()).length() > 0.1 { camera.up } else { Vec3::from([0.0, 0.0, 1.0]) };
    let up = if along.cross(up.as_dvec3()).length() > 0.1 { up } else { Vec3::Y };
    let distance = 2.0 * radius * 10.0_f64.powf(decades);
    let target = framing.target.as_dvec3();
    #[expect(clippy::cast_possible_truncation, reason = "degrees")]
    let fov_y = (2.0 * (1.1 * radius / distance).atan().to_degrees()) as f32;
    let new = Camera { eye: (target - along * distance).as_vec3(), target: framing.target, up, fov_y };
    if new.fault().is_none() { new } else { *camera }
}

/// Of how many neighbouring pixels in the middle of a picture the rays are the same, rounded as they are to `f32`: 1 where each
/// has its own, infinity where all share one.
pub(crate) fn pixels_a_ray(camera: &Camera, [width, height]: [u32; 2]) -> f64 {
    let pixels = camera.pixels(width, height);
    let [left, top] = [width, height].map(|side| (side / 2).saturating_sub(16));
    let places = (top..height.min(top + 32)).flat_map(|y| (left..width.min(left + 32)).map(move |x| (x, y)));
    let rays: Vec<[u32; 3]> = places.map(|(x, y)| pixels.ray(x, y).direction.to_array().map(f32::to_bits)).collect();
    let distinct: std::collections::HashSet<&[u32; 3]> = rays.iter().collect();
    if distinct.len() == 1 && rays.len() > 1 { f64::INFINITY } else { rays.len() as f64 / distinct.len().max(1) as f64 }
}

#[cfg(test)]
mod tests {
    use rayproof::scene::{Geometry, Sphere};

    use super::*;

    const CAMERA: Camera = Camera { eye: Vec3::new(0.0, 0.0, 4.0), target: Vec3::ZERO, up: Vec3::Y, fov_y: 60.0 };

    fn near(a: Vec3, b: [f32; 3]) {
        assert!(a.distance(Vec3::from(b)) < 1e-5, "{a} is not {b:?}");
    }

    #[test]
    fn moves_go_where_they_should() {
        let quarter = std::f64::consts::FRAC_PI_2;
        near(orbit(&CAMERA, quarter, 0.0).eye, [4.0, 0.0, 0.0]);
        near(look(&CAMERA, quarter, 0.0).target, [4.0, 0.0, 4.0]);
        let high = orbit(&CAMERA, 0.0, 10.0);
        assert!(high.eye.y > 3.99 && high.fault().is_none(), "{high:?}");
        let low = look(&CAMERA, 0.0, -10.0);
        assert!(low.target.y < -3.99 && low.fault().is_none(), "{low:?}");
        near(dolly(&CAMERA, 0.5).eye, [0.0, 0.0, 2.0]);
        near(fly(&CAMERA, [0.0, 0.0, 0.5]).target, [0.0, 0.0, -2.0]);
        near(focus(&CAMERA, Vec3::ONE).target, [1.0; 3]);
        // The picture's height at the target is 8 tan(30 degrees).
        near(pan(&CAMERA, 1.0, 0.0).target, [8.0 * 30.0_f32.to_radians().tan(), 0.0, 0.0]);
        assert!((zoom(&CAMERA, 0.5).fov_y.to_radians() * 0.5).tan() * 2.0 - 30.0_f32.to_radians().tan() < 1e-6);
    }

    #[test]
    fn points_are_found_where_their_rays_go_through() {
        let (size, pixels) = ([640, 480], CAMERA.pixels(640, 480));
        for (x, y) in [(0, 0), (639, 100), (320, 479), (7, 300)] {
            let ray = pixels.ray(x, y);
            let point = ray.origin.as_dvec3() + 3.0 * ray.direction.as_dvec3();
            let [u, v] = project(&CAMERA, size, point).unwrap_or_default();
            let off = [u * 640.0 - f64::from(x) - 0.5, v * 480.0 - f64::from(y) - 0.5];
            assert!(off.iter().all(|o| o.abs() < 1e-3), "{off:?}");
        }
        assert_eq!(project(&CAMERA, size, DVec3::new(0.0, 0.0, 9.0)), None);
    }

    #[test]
    fn a_camera_that_would_not_see_is_refused() {
        assert_eq!(dolly(&CAMERA, 0.0), CAMERA);
        assert_eq!(dolly(&CAMERA, 1e300), CAMERA);
        assert_eq!(focus(&CAMERA, CAMERA.eye), CAMERA);
        assert_eq!(zoom(&CAMERA, 0.0), CAMERA);
        let far = Camera { eye: Vec3::new(1e9, 0.0, 4.0), target: Vec3::new(1e9, 0.0, 3.0), ..CAMERA };
        assert_eq!(pan(&far, 0.0, 0.0), far);
    }

    #[test]
    fn a_zoom_beyond_f32_is_noticed() {
        let aside = Camera { eye: Vec3::new(3.0, 2.0, 4.0), fov_y: 1e-5, ..CAMERA };
        assert!(pixels_a_ray(&aside, [800, 600]) > 10.0);
        assert!(pixels_a_ray(&Camera { fov_y: 40.0, ..aside }, [800, 600]) < 1.01);
        assert!(pixels_a_ray(&aside, [1, 1]) <= 1.0);
        assert!(pixels_a_ray(&Camera { fov_y: 1e-9, ..aside }, [800, 600]).is_infinite());
    }

    #[test]
    fn walking_away_keeps_the_size_and_tells_pixels_apart() {
        let ball = Sphere { center: Vec3::new(3.0, 1.0, 0.0), radius: 2.0 };
        let scene = Scene::new(vec![Geometry::Spheres(vec![ball])]).expect("made of finite numbers");
        for decades in [0.0, 1.0, 4.0, 8.0] {
            let camera = walk_away(&CAMERA, &scene, decades);
            let distance = f64::from(camera.eye.distance(camera.target));
            assert!(
                (distance / 10.0_f64.powf(decades) / (2.0 * 2.0 * 3.0_f64.sqrt()) - 1.0).abs() < 1e-3,
                "{camera:?}"
            );
            let pixels = camera.pixels(800, 600);
            let directions =
                [pixels.ray(400, 300), pixels.ray(401, 300), pixels.ray(400, 301)].map(|ray| ray.direction);
            assert!(directions[0] != directions[1] && directions[0] != directions[2], "{directions:?}");
            assert!(pixels_a_ray(&camera, [800, 600]) < 1.01, "{decades}");
            // At the same share of the picture whatever the distance: where the sphere's rim is.
            let side = (f64::from(camera.fov_y).to_radians() * 0.5).tan() * distance / ball.radius as f64;
            assert!((side / (1.1 * 3.0_f64.sqrt()) - 1.0).abs() < 1e-3, "{decades}: {side}");
        }
    }
}
