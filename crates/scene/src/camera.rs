use glam::{DVec3, Vec3};

use crate::{Geometry, Ray, Scene};

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
    /// It frames all triangles, and the spheres from the smallest up to the first whose radius is more than 30 times
    /// the half diagonal of the box around all that came before: a ground sphere does not turn the rest into a dot.
    /// For any finite scene the camera is finite and looks at a point other than its own, even for an empty one.
    #[must_use]
    pub fn framing(scene: &Scene) -> Self {
        let (low, high) = framed_box(scene).unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
        let target = ((low + high) * 0.5).clamp(DVec3::splat(f64::from(f32::MIN)), DVec3::splat(f64::from(f32::MAX)));
        let half = (high - low).length() * 0.5;
        // From a single point, any distance will do. A far target needs one that is many times the spacing of the f32
        // around it, and a tiny scene one that is no subnormal.
        let half = if half > 0.0 { half } else { 1.0 };
        let half = half.max(target.abs().max_element() * 2.0_f64.powi(-16)).max(1e-36);
        let fov_y = 40.0_f32;
        let distance = half / (f64::from(fov_y).to_radians() * 0.5).sin();
        let offset = DVec3::new(0.4, 0.35, 1.0).normalize() * distance;
        let eye = DVec3::from_array(std::array::from_fn(|axis| stand(target[axis], offset[axis])));
        Self { eye: eye.as_vec3(), target: target.as_vec3(), up: Vec3::Y, fov_y }
    }

    /// What is wrong with it, and what would be right; `None` for a camera that sees.
    #[must_use]
    pub fn fault(&self) -> Option<[&'static str; 2]> {
        let &Self { eye, target, up, fov_y } = self;
        if !(eye.is_finite() && target.is_finite() && up.is_finite() && fov_y.is_finite()) {
            Some(["a number is not finite", "give finite numbers within the range of f32"])
        } else if eye == target {
            Some(["eye and target are the same point", "give two points"])
        } else if parallel(target.as_dvec3() - eye.as_dvec3(), up.as_dvec3()) {
            Some(["up is along the line of sight, or zero", "give an up that is not"])
        } else if !(fov_y > 0.0 && fov_y < 180.0) {
            Some(["fov_y is out of range", "give degrees, above 0 and below 180"])
        } else {
            None
        }
    }

    /// The table `[camera]` of a scene file that reads back as this camera.
    #[must_use]
    pub fn table(&self) -> String {
        let vector = |v: Vec3| format!("[{}]", v.to_array().map(decimal).join(", "));
        let [eye, target, up] = [self.eye, self.target, self.up].map(vector);
        format!("[camera]\neye = {eye}\ntarget = {target}\nup = {up}\nfov_y = {}\n", decimal(self.fov_y))
    }

    /// The rays through the pixel centres of a `width` x `height` picture, row by row from the top left.
    ///
    /// `rows` picks the rows.
    pub fn rays(&self, width: u32, height: u32, rows: std::ops::Range<u32>) -> impl Iterator<Item = Ray> {
        let pixels = self.pixels(width, height);
        rows.flat_map(move |y| (0..width).map(move |x| (x, y))).map(move |(x, y)| pixels.ray(x, y))
    }

    /// The pixels of a `width` x `height` picture, to be asked for their rays one by one.
    #[must_use]
    pub fn pixels(&self, width: u32, height: u32) -> Pixels {
        let (eye, target, up) = (self.eye.as_dvec3(), self.target.as_dvec3(), self.up.as_dvec3());
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        let up = right.cross(forward);
        let half = (f64::from(self.fov_y).to_radians() * 0.5).tan();
        Pixels { origin: self.eye, forward, right, up, half, size: [f64::from(width), f64::from(height)] }
    }
}

/// A picture's pixels, as a camera sees them.
#[derive(Clone, Copy, Debug)]
pub struct Pixels {
    origin: Vec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Half the height of the picture at a distance of 1.
    half: f64,
    size: [f64; 2],
}

impl Pixels {
    /// The ray through the centre of a pixel, counted from the top left.
    ///
    /// Its direction is computed in `f64`, has unit length, and is rounded once.
    #[must_use]
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let &Self { origin, forward, right, up, half, size: [w, h] } = self;
        let sx = (2.0 * (f64::from(x) + 0.5) - w) / h * half;
        let sy = (h - 2.0 * (f64::from(y) + 0.5)) / h * half;
        Ray::new(origin, (forward + right * sx + up * sy).normalize().as_vec3())
    }
}

/// Whether what is left of `up` after its part along the line of sight is no more than the rounding of an f64.
fn parallel(sight: DVec3, up: DVec3) -> bool {
    sight.normalize_or_zero().cross(up.normalize_or_zero()).length() < 1e-12
}

/// The shortest decimal that reads back as the same f32 by way of an f64, as a scene file is read.
fn decimal(x: f32) -> String {
    let short = format!("{x:?}");
    #[expect(clippy::cast_possible_truncation, reason = "this is how it will be read")]
    let reads_back = short.parse::<f64>().is_ok_and(|wide| wide as f32 == x);
    if reads_back { short } else { format!("{:?}", f64::from(x)) }
}

/// Where to stand on one axis: `offset > 0` from the target, on the other side where that is out of range of f32.
fn stand(target: f64, offset: f64) -> f64 {
    let max = f64::from(f32::MAX);
    if target + offset > max && target > 0.0 { (target - offset).max(-max) } else { (target + offset).min(max) }
}

/// The box of what [`Camera::framing`] frames, in `f64` so that nothing overflows; `None` where there is nothing.
fn framed_box(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let union = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
    let mut spheres = Vec::new();
    let mut triangles = None;
    for geometry in scene.geometries() {
        match geometry {
            Geometry::Spheres(table) => spheres.extend_from_slice(table),
            Geometry::Mesh(mesh) => {
                let used = mesh.triangles.iter().flatten().map(|&v| mesh.vertices[v as usize].as_dvec3());
                triangles = used.map(|v| (v, v)).chain(triangles).reduce(union);
            }
        }
    }
    spheres.sort_unstable_by(|a, b| a.radius.total_cmp(&b.radius));
    spheres
        .iter()
        .try_fold(triangles, |framed, s| {
            let (c, r) = (s.center.as_dvec3(), f64::from(s.radius));
            let half = framed.map_or(0.0, |(low, high): (DVec3, DVec3)| (high - low).length() * 0.5);
            // All that follow are as large or larger.
            if half > 0.0 && r > 30.0 * half {
                return Err(framed);
            }
            Ok(Some(framed.into_iter().fold((c - r, c + r), union)))
        })
        .unwrap_or_else(|framed| framed)
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::*;
    use crate::{Mesh, Sphere};

    fn spheres(table: &[(Vec3, f32)]) -> Geometry {
        Geometry::Spheres(table.iter().map(|&(center, radius)| Sphere { center, radius }).collect())
    }

    fn triangle(corners: [Vec3; 3]) -> Geometry {
        Geometry::Mesh(Mesh { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] })
    }

    /// What [`Camera::rays`] and a scene file ask of a camera.
    fn check_valid(camera: &Camera) {
        assert!(camera.eye.is_finite() && camera.target.is_finite(), "{camera:?}");
        assert_ne!(camera.eye, camera.target);
        let sight = (camera.target.as_dvec3() - camera.eye.as_dvec3()).normalize();
        assert!(sight.cross(camera.up.as_dvec3()).length() > 0.1, "{camera:?}");
        for ray in camera.rays(3, 2, 0..2) {
            assert_eq!(ray.fault(), None, "{camera:?}");
            assert!((ray.direction.as_dvec3().length() - 1.0).abs() < 1e-6, "{camera:?}");
        }
    }

    /// Whether a point is within the vertical field of view of a square picture.
    fn sees(camera: &Camera, point: Vec3) -> bool {
        let sight = (camera.target.as_dvec3() - camera.eye.as_dvec3()).normalize();
        let to = (point.as_dvec3() - camera.eye.as_dvec3()).normalize();
        sight.dot(to).acos().to_degrees() <= f64::from(camera.fov_y) * 0.5 + 1e-3
    }

    #[test]
    fn a_ground_sphere_does_not_hide_the_rest() {
        let ground = (Vec3::new(0.0, -1e6, 0.0), 1e6);
        let beads = [(Vec3::new(-1.0, 0.5, 0.0), 0.5), (Vec3::new(1.0, 0.25, 0.0), 0.25)];
        let without = Camera::framing(&Scene::new(vec![spheres(&beads)]).expect("a valid scene"));
        for scene in [
            vec![spheres(&[ground, beads[0], beads[1]])],
            vec![spheres(&beads), spheres(&[ground])],
            vec![spheres(&[ground, (Vec3::ZERO, 2e6)]), spheres(&beads)],
        ] {
            assert_eq!(Camera::framing(&Scene::new(scene).expect("a valid scene")), without);
        }
        let mesh = triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
        let without = Camera::framing(&Scene::new(vec![mesh.clone()]).expect("a valid scene"));
        assert_eq!(Camera::framing(&Scene::new(vec![spheres(&[ground]), mesh]).expect("a valid scene")), without);
    }

    #[test]
    fn large_spheres_of_a_wide_scene_are_framed() {
        let far = Vec3::new(100.0, 0.0, 0.0);
        let scene =
            Scene::new(vec![spheres(&[(Vec3::ZERO, 0.1), (far, 0.1), (Vec3::ZERO, 50.0)])]).expect("a valid scene");
        let camera = Camera::framing(&scene);
        for point in [far, Vec3::new(-50.0, 0.0, 0.0), Vec3::new(0.0, 50.0, 0.0), Vec3::new(0.0, -50.0, 0.0)] {
            assert!(sees(&camera, point), "{point} from {camera:?}");
        }
        // A sphere alone is framed, whatever its size, and so is one around a point.
        for radius in [1e-30, 1.0, 1e6, 1e30] {
            let camera = Camera::framing(
                &Scene::new(vec![spheres(&[(Vec3::ZERO, 0.0), (Vec3::ZERO, radius)])]).expect("a valid scene"),
            );
            assert!(sees(&camera, Vec3::Y * radius) && sees(&camera, Vec3::X * radius), "{camera:?}");
        }
    }

    #[test]
    fn vertices_without_a_triangle_are_not_framed() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let mesh = Mesh { vertices: [&corners[..], &[Vec3::splat(1e9)]].concat(), triangles: vec![[0, 1, 2]] };
        let with = Camera::framing(&Scene::new(vec![Geometry::Mesh(mesh)]).expect("a valid scene"));
        assert_eq!(with, Camera::framing(&Scene::new(vec![triangle(corners)]).expect("a valid scene")));
    }

    #[test]
    fn any_finite_scene_has_a_valid_camera() {
        check_valid(&Camera::framing(&Scene::default()));
        check_valid(&Camera::framing(
            &Scene::new(vec![spheres(&[]), Geometry::Mesh(Mesh::default())]).expect("a valid scene"),
        ));
        for x in [0.0, f32::from_bits(1), 1e-38, 1e-30, 1.0, 1e6, 1e30, f32::MAX] {
            for v in [x, -x].map(|x| [Vec3::splat(x), Vec3::new(x, 0.0, 0.0), Vec3::new(0.0, -x, x)]).as_flattened() {
                check_valid(&Camera::framing(&Scene::new(vec![triangle([*v; 3])]).expect("a valid scene")));
                check_valid(&Camera::framing(
                    &Scene::new(vec![triangle([*v, -*v, Vec3::ZERO])]).expect("a valid scene"),
                ));
                for radius in [0.0, 1e-30, 1.0, f32::MAX] {
                    check_valid(&Camera::framing(&Scene::new(vec![spheres(&[(*v, radius)])]).expect("a valid scene")));
                }
            }
        }
    }

    /// Its seed is printed, so that a failure names it.
    fn config() -> ProptestConfig {
        const SEED: u64 = 0xca3e8a;
        println!("seed {SEED:#x}");
        ProptestConfig { rng_seed: RngSeed::Fixed(SEED), failure_persistence: None, ..ProptestConfig::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn any_finite_spheres_have_a_valid_camera(
            table in prop::collection::vec(prop::array::uniform4(prop::num::f32::NORMAL | prop::num::f32::SUBNORMAL), 0..6),
        ) {
            let table: Vec<_> = table.iter().map(|&[x, y, z, r]| (Vec3::new(x, y, z), r.abs())).collect();
            check_valid(&Camera::framing(&Scene::new(vec![spheres(&table)]).expect("a valid scene")));
        }
    }

    #[test]
    fn framing_sees_every_vertex() {
        let corners = [Vec3::new(-3.0, 2.0, 1.0), Vec3::new(5.0, -1.0, 0.0), Vec3::new(0.0, 0.0, 7.0)];
        let camera = Camera::framing(&Scene::new(vec![triangle(corners)]).expect("a valid scene"));
        assert!(corners.iter().all(|&corner| sees(&camera, corner)), "{camera:?}");
        assert!(!sees(&camera, *corners.last().unwrap() * 10.0), "the check sees everything");
    }
}
