use glam::{DVec3, Vec3};

use crate::{Ray, Scene};

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub eye: Vec3,
    /// What it looks at; not the eye.
    pub target: Vec3,
    /// What is up in the picture; not along the line of sight.
    pub up: Vec3,
    /// The vertical field of view, in degrees, above 0 and below 180.
    pub fov_y: f32,
}

impl Camera {
    /// A camera that sees the whole scene from the front, a little to the side and above.
    ///
    /// It frames the box of the triangles and of the spheres no larger than 100 times the median geometry, so that
    /// a ground sphere does not turn the rest into a dot.
    #[must_use]
    pub fn framing(scene: &Scene) -> Self {
        let [low, high] = scene.bounds().unwrap_or([Vec3::splat(-1.0), Vec3::ONE]);
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let target = (low + high) * 0.5;
        let radius = ((high - low).length() * 0.5).max(f64::from(f32::MIN_POSITIVE));
        let fov_y = 40.0_f32;
        let distance = radius / (f64::from(fov_y).to_radians() * 0.5).sin();
        let eye = target + DVec3::new(0.4, 0.35, 1.0).normalize() * distance;
        Self { eye: eye.as_vec3(), target: target.as_vec3(), up: Vec3::Y, fov_y }
    }

    /// The rays through the pixel centres of a `width` x `height` picture, row by row from the top left.
    ///
    /// Directions are computed in `f64`, have unit length, and are rounded once. `row` picks the rows.
    pub fn rays(&self, width: u32, height: u32, rows: std::ops::Range<u32>) -> impl Iterator<Item = Ray> {
        let (eye, target, up) = (self.eye.as_dvec3(), self.target.as_dvec3(), self.up.as_dvec3());
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        let up = right.cross(forward);
        let half = (f64::from(self.fov_y).to_radians() * 0.5).tan();
        let (w, h) = (f64::from(width), f64::from(height));
        let origin = self.eye;
        rows.flat_map(move |y| (0..width).map(move |x| (x, y))).map(move |(x, y)| {
            let sx = (2.0 * (f64::from(x) + 0.5) - w) / h * half;
            let sy = (h - 2.0 * (f64::from(y) + 0.5)) / h * half;
            Ray::new(origin, (forward + right * sx + up * sy).normalize().as_vec3())
        })
    }
}
