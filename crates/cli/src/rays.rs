//! `rayproof rays`: files of rays that suit a scene.

use std::path::PathBuf;

use rayproof::BATCH;
use rayproof::files::RayWriter;
use rayproof::rays::{Diffuse, Incoherent, Primary};
use rayproof::scene::{Camera, Ray, Scene};

use crate::args::{Place, Rays};
use crate::choices::Kind;
use crate::exit::{Code, Failure, say};
use crate::interrupt::{self, Writing};
use crate::load::Loaded;
use crate::parse::Size;
use crate::progress::Progress;
use crate::summary::grouped;
use crate::target;

/// The picture that rays are made for where none is given.
const SIZE: Size = Size { width: 1024, height: 1024 };

/// Runs the command.
pub(crate) fn run(args: &Rays) -> Result<(), Failure> {
    if args.kind == Kind::Primary && args.count.is_some() {
        let message = "--count: primary rays are those of a picture; give --size WxH";
        return Err(Failure::new(Code::Usage, message));
    }
    args.to.of_output(&args.output)?;
    let Loaded { scene: loaded, notes, .. } = Loaded::read(&args.scene, &Place::default())?;
    if loaded.origin != [0.0; 3] {
        let message = format!(
            "{}: it has an origin, and rays of its place are not f32; make them in float64 with it, or leave it out here",
            args.scene.display()
        );
        return Err(Failure::new(Code::Usage, message));
    }
    target::is_no_input(&args.output, loaded.sources.iter().map(PathBuf::as_path))?;
    for note in notes.iter().filter(|_| !args.quiet) {
        say(format_args!("note    {note}"));
    }
    let camera = loaded.camera.unwrap_or_else(|| Camera::framing(&loaded.scene));
    let seen = |Size { width, height }| Primary { camera: &camera, width, height };
    match args.kind {
        Kind::Primary => primary(args, seen(args.size.unwrap_or(SIZE))),
        Kind::Incoherent => incoherent(args, &loaded.scene),
        Kind::Diffuse => {
            let size = args.size.unwrap_or_else(|| args.count.map_or(SIZE, square));
            diffuse(args, &loaded.scene, seen(size))
        }
    }
}

/// Where rays go: the file, and the bar that says how far it has come.
struct Sink {
    writer: RayWriter,
    progress: Progress,
    rays: u64,
    _writing: Writing,
}

impl Sink {
    fn create(args: &Rays, total: u64) -> Result<Self, Failure> {
        let writing = Writing::begin();
        let writer = RayWriter::create(&args.output, Some(args.to.of_output(&args.output)?), false, Some(total))?;
        Ok(Self { writer, progress: Progress::new("writing", Some(total), args.quiet), rays: 0, _writing: writing })
    }

    fn write(&mut self, rays: &[Ray]) -> Result<(), Failure> {
        interrupt::check()?;
        self.writer.write(rays)?;
        self.progress.add(rays.len());
        self.rays += rays.len() as u64;
        Ok(())
    }

    fn finish(self, args: &Rays, what: &str) -> Result<(), Failure> {
        self.writer.finish()?;
        drop(self.progress);
        if !args.quiet {
            say(format_args!("rays    {} {what}, {}", grouped(self.rays), args.output.display()));
        }
        Ok(())
    }
}

fn primary(args: &Rays, primary: Primary<'_>) -> Result<(), Failure> {
    let mut sink = Sink::create(args, primary.pixels())?;
    for rays in primary.blocks(BATCH) {
        sink.write(&rays)?;
    }
    sink.finish(args, "primary")
}

fn incoherent(args: &Rays, scene: &Scene) -> Result<(), Failure> {
    let total = args.count.unwrap_or_else(|| args.size.unwrap_or(SIZE).pixels());
    let incoherent = Incoherent::new(scene, args.seed);
    let mut sink = Sink::create(args, total)?;
    for first in (0..total).step_by(BATCH) {
        sink.write(&incoherent.rays(first..total.min(first.saturating_add(BATCH as u64))))?;
    }
    sink.finish(args, "incoherent")
}

fn diffuse(args: &Rays, scene: &Scene, primary: Primary<'_>) -> Result<(), Failure> {
    let progress = Progress::new("looking", Some(primary.pixels()), args.quiet);
    let diffuse = Diffuse::new(scene, primary, |rays| progress.add(rays))?;
    drop(progress);
    let total = args.count.unwrap_or(diffuse.hits());
    if diffuse.hits() == 0 && total > 0 {
        let message = format!(
            "{}: none of {} primary rays hits the scene, so that no diffuse ray can leave it; \
             give a scene file with a [camera] that sees it",
            args.scene.display(),
            grouped(primary.pixels())
        );
        return Err(Failure::new(Code::BadInput, message));
    }
    let mut sink = Sink::create(args, total)?;
    diffuse.send(total, args.seed, |rays| sink.write(rays))?;
    sink.finish(args, "diffuse")
}

/// A square picture of about `count` pixels, neither tiny nor huge.
fn square(count: u64) -> Size {
    let side = u32::try_from(count.isqrt().clamp(64, 4096)).expect("4096 at most");
    Size { width: side, height: side }
}
