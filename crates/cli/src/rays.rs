//! `rayproof rays`: files of rays that suit a scene.

use std::path::PathBuf;

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use rayproof::files::RayWriter;
use rayproof::scene::{Camera, Ray, Scene};

use crate::args::Rays;
use crate::bounce::finite;
use crate::choices::Kind;
use crate::diffuse::diffuse;
use crate::exit::{Code, Failure, say};
use crate::interrupt::{self, Writing};
use crate::parse::Size;
use crate::pipeline::BATCH;
use crate::progress::Progress;
use crate::random::Random;
use crate::summary::{grouped, nothing_to_hit};
use crate::target;

/// The picture that rays are made for where none is given.
pub(crate) const SIZE: Size = Size { width: 1024, height: 1024 };

/// Runs the command.
pub(crate) fn run(args: &Rays) -> Result<(), Failure> {
    if args.kind == Kind::Primary && args.count.is_some() {
        let message = "--count: primary rays are those of a picture; give --size WxH";
        return Err(Failure::new(Code::Usage, message));
    }
    args.to.of_output(&args.output)?;
    let loaded = rayproof::files::load(&args.scene)?;
    target::is_no_input(&args.output, loaded.sources.iter().map(PathBuf::as_path))?;
    if let Some(note) = nothing_to_hit(&loaded.scene, &args.scene).filter(|_| !args.quiet) {
        say(format_args!("note    {note}"));
    }
    let camera = loaded.camera.unwrap_or_else(|| Camera::framing(&loaded.scene));
    let size = args.size.unwrap_or(SIZE);
    match args.kind {
        Kind::Primary => primary(args, &camera, size),
        Kind::Incoherent => incoherent(args, &loaded.scene),
        Kind::Diffuse => diffuse(args, &loaded.scene, &camera),
    }
}

/// Where rays go: the file, and the bar that says how far it has come.
pub(crate) struct Sink {
    writer: RayWriter,
    progress: Progress,
    rays: u64,
    _writing: Writing,
}

impl Sink {
    pub(crate) fn create(args: &Rays, total: u64) -> Result<Self, Failure> {
        let writing = Writing::begin();
        let writer = RayWriter::create(&args.output, Some(args.to.of_output(&args.output)?), false, Some(total))?;
        Ok(Self { writer, progress: Progress::new("writing", Some(total), args.quiet), rays: 0, _writing: writing })
    }

    pub(crate) fn write(&mut self, rays: &[Ray]) -> Result<(), Failure> {
        interrupt::check()?;
        self.writer.write(rays)?;
        self.progress.add(rays.len());
        self.rays += rays.len() as u64;
        Ok(())
    }

    pub(crate) fn finish(self, args: &Rays, what: &str) -> Result<(), Failure> {
        self.writer.finish()?;
        drop(self.progress);
        if !args.quiet {
            say(format_args!("rays    {} {what}, {}", grouped(self.rays), args.output.display()));
        }
        Ok(())
    }
}

fn primary(args: &Rays, camera: &Camera, size: Size) -> Result<(), Failure> {
    let mut sink = Sink::create(args, size.pixels())?;
    for rows in row_blocks(size, BATCH) {
        let rays: Vec<Ray> = camera.rays(size.width, size.height, rows).collect();
        sink.write(&rays)?;
    }
    sink.finish(args, "primary")
}

/// Blocks of whole rows: of about `block` pixels, or one row.
pub(crate) fn row_blocks(size: Size, block: usize) -> impl Iterator<Item = std::ops::Range<u32>> {
    let step = (u32::try_from(block).unwrap_or(u32::MAX) / size.width).max(1);
    (0..size.height).step_by(step as usize).map(move |y| y..size.height.min(y.saturating_add(step)))
}

fn incoherent(args: &Rays, scene: &Scene) -> Result<(), Failure> {
    let total = args.count.unwrap_or_else(|| args.size.unwrap_or(SIZE).pixels());
    let [low, high] = framed(scene);
    let mut sink = Sink::create(args, total)?;
    let mut rays = Vec::new();
    for first in (0..total).step_by(BATCH) {
        let last = total.min(first.saturating_add(BATCH as u64));
        rays.clear();
        rays.par_extend((first..last).into_par_iter().map(|i| crossing(low, high, &mut Random::new(args.seed, i))));
        sink.write(&rays)?;
    }
    sink.finish(args, "incoherent")
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
    use rayproof::scene::{Geometry, Sphere};

    use super::*;

    #[test]
    fn row_blocks_cover_every_row_once_and_are_about_a_batch() {
        for (width, height) in [(1, 1), (800, 600), (1024, 1024), (1024, 5000), (65535, 40), (3, 65535)] {
            let mut next = 0;
            for rows in row_blocks(Size { width, height }, BATCH) {
                assert_eq!(rows.start, next);
                assert!(!rows.is_empty() && rows.len() as u64 * u64::from(width) <= BATCH as u64);
                next = rows.end;
            }
            assert_eq!(next, height);
        }
    }

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
        let scene = |spheres: &[Sphere]| Scene::new(vec![Geometry::Spheres(spheres.to_vec())]).expect("a valid scene");
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
