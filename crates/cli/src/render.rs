//! `rayproof render`: a picture of a scene, or of the error of every pixel.

use std::path::PathBuf;

use rayon::prelude::*;
use rayproof::rays::Primary;
use rayproof::scene::{Camera, FlatHit, Ray, Scene};
use rayproof::{Intersector, Options, Precision};
use rayproof_oracle::Oracle;
use rayproof_picture::color::Rgb;
use rayproof_picture::shade;

use crate::args::Render;
use crate::choices::Show;
use crate::exit::{Code, Failure, say};
use crate::load::Loaded;
use crate::picture::Picture;
use crate::progress::Progress;
use crate::{legend, summary, target};

/// Runs the command.
pub(crate) fn run(args: &Render) -> Result<(), Failure> {
    let png = args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if !png && args.output.as_os_str() != "-" {
        let message = format!("--output: {}: a picture is a PNG; give a name that ends in .png", args.output.display());
        return Err(Failure::new(Code::Usage, message));
    }
    if args.show == Show::Stage && args.precision != Precision::Exact {
        let message = "--show tier: only the precision exact is a cascade of stages; give --precision exact";
        return Err(Failure::new(Code::Usage, message));
    }
    target::has_folder(&args.output)?;
    let Loaded { scene: loaded, notes, .. } = Loaded::read(&args.scene, &args.place)?;
    target::is_no_input(&args.output, loaded.sources.iter().map(PathBuf::as_path))?;
    let camera = loaded.camera.unwrap_or_else(|| Camera::framing(&loaded.scene));
    let options = Options { precision: args.precision, device: args.device.clone(), ..Options::default() };
    let engine = Intersector::new(&loaded.scene, &options)?;
    let view = View { args, scene: &loaded.scene, camera, engine };
    view.draw()?.save(&args.output)?;
    if !args.quiet {
        say(format_args!("{}picture {}", summary::device_lines(view.engine.device(), &notes), args.output.display()));
    }
    Ok(())
}

/// A scene, seen through a camera.
struct View<'a> {
    args: &'a Render,
    scene: &'a Scene,
    camera: Camera,
    engine: Intersector,
}

impl View<'_> {
    fn draw(&self) -> Result<Picture, Failure> {
        let mut picture = Picture::new(self.args.size)?;
        let scene = self.scene;
        match self.args.show {
            Show::Normal => self.shade(&mut picture, |ray, hit| shade::by_normal(scene, ray, hit))?,
            Show::Primitive => self.shade(&mut picture, |_, hit| shade::by_primitive(hit))?,
            Show::Uv => self.shade(&mut picture, |_, hit| shade::by_uv(hit))?,
            Show::Error => {
                let oracle = Oracle::new(scene);
                self.shade(&mut picture, |ray, hit| shade::by_error(&oracle.hit(ray), hit))?;
                legend::draw(&mut picture);
            }
            Show::Stage => {
                let mut stages = Vec::new();
                self.each_block(|rays| {
                    stages.clear();
                    stages.resize(rays.len(), 0);
                    self.engine.deciding_stages(rays, &mut stages)?;
                    picture.push(stages.iter().map(|&stage| shade::by_stage(stage)));
                    Ok(())
                })?;
                legend::draw_stages(&mut picture);
            }
            Show::Depth => {
                let mut distances = Vec::new();
                self.trace(|_, hits| distances.extend(hits.iter().map(|hit| hit.t)))?;
                picture.push(shade::by_depth(&distances));
            }
        }
        Ok(picture)
    }

    /// Colours every pixel by its own ray and hit.
    fn shade(&self, picture: &mut Picture, color: impl Fn(&Ray, &FlatHit) -> Rgb + Sync) -> Result<(), Failure> {
        self.trace(|rays, hits| {
            let colors: Vec<Rgb> = rays.par_iter().zip(hits).map(|(ray, hit)| color(ray, hit)).collect();
            picture.push(colors);
        })
    }

    /// Calls `f` with the rays of each block of rows and their hits.
    fn trace(&self, mut f: impl FnMut(&[Ray], &[FlatHit])) -> Result<(), Failure> {
        let mut hits = Vec::new();
        self.each_block(|rays| {
            hits.clear();
            hits.resize(rays.len(), FlatHit::MISS);
            self.engine.closest_flat(rays, &mut hits)?;
            f(rays, &hits);
            Ok(())
        })
    }

    /// Calls `f` with the rays of each block of rows.
    fn each_block(&self, mut f: impl FnMut(&[Ray]) -> Result<(), Failure>) -> Result<(), Failure> {
        let size = self.args.size;
        // The oracle is slow: small blocks, so that the bar moves.
        let block = if self.args.show == Show::Error { 1 << 11 } else { rayproof::BATCH };
        let progress = Progress::new("rendering", Some(size.pixels()), self.args.quiet);
        let primary = Primary { camera: &self.camera, width: size.width, height: size.height };
        for rays in primary.blocks(block) {
            f(&rays)?;
            progress.add(rays.len());
        }
        Ok(())
    }
}
