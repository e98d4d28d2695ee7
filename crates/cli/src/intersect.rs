//! `rayproof intersect`: a file of rays in, a file of answers out.

use std::path::PathBuf;
use std::time::Instant;

use rayproof::files::{Format, HitWriter, KeptColumns, RayReader};
use rayproof::scene::{Hit, Scene};
use rayproof::stream::{Checked, Done, Job, Shard};
use rayproof::{Intersector, Options, Precision};

use crate::args::Intersect;
use crate::check::check;
use crate::choices::{OnRounding, Query};
use crate::exit::{Code, Failure, print_json, say};
use crate::interrupt::{self, Writing};
use crate::judged::Judged;
use crate::load::Loaded;
use crate::progress::Progress;
use crate::summary::{RoundingOf, SceneSize, Seconds, Summary};
use crate::target;

/// Runs the command; `started` is when the program did.
pub(crate) fn run(args: &Intersect, started: Instant) -> Result<(), Failure> {
    if args.json && args.output.as_os_str() == "-" {
        let message = "--json: the hits go to stdout already; give -o a file, or leave --json out";
        return Err(Failure::new(Code::Usage, message));
    }
    if args.query == Query::Count && args.precision != Precision::Exact {
        let message = "--query count: crossings are counted exactly or not at all; give --precision exact";
        return Err(Failure::new(Code::Usage, message));
    }
    let format = args.to.of_output(&args.output)?;
    if format == Format::Npy && !args.keep.is_empty() {
        let message =
            "--keep: .npy has no place for columns of the rays; give -o a .csv or .parquet, or --to one of them";
        return Err(Failure::new(Code::Usage, message));
    }
    let loading = Instant::now();
    let mut loaded = Loaded::read(&args.scene, &args.place)?;
    let load = loading.elapsed().as_secs_f64();
    target::is_no_input(&args.output, loaded.scene.sources.iter().chain([&args.rays]).map(PathBuf::as_path))?;
    let mut rays = args.shard.unwrap_or(Shard::WHOLE).open(&args.rays, args.invalid.into())?;
    let kept = rays.keep(&args.keep)?;
    let passed_over = rays.passed_over(&kept);
    rays.subtract(loaded.scene.origin);
    if args.place.rounding == OnRounding::Error {
        rays.refuse_shifts_beyond(loaded.harmless());
    }
    let options = Options { precision: args.precision, device: args.device.clone(), ..Options::default() };
    let engine = Intersector::new(&loaded.scene.scene, &options)?;
    loaded.notes.extend(passed_over.map(|what| format!("{}: {what}; --keep passes columns on", args.rays.display())));
    let run = Run { args, format, loaded, kept, engine, started, load };
    match args.query {
        Query::Closest => run.all::<Hit>(rays),
        Query::Any => run.all::<u8>(rays),
        Query::Count => run.all::<u32>(rays),
    }
}

/// What is ready before the first ray is read.
struct Run<'a> {
    args: &'a Intersect,
    format: Format,
    loaded: Loaded,
    kept: KeptColumns,
    engine: Intersector,
    started: Instant,
    /// Seconds that loading the scene took.
    load: f64,
}

impl Run<'_> {
    fn all<A: Judged>(&self, rays: RayReader) -> Result<(), Failure> {
        let done = self.answer::<A>(rays)?;
        let checked = check(self.scene(), &done.samples, self.args.precision, self.args.quiet);
        let summary = self.summary(&done, checked);
        if !self.args.quiet {
            say(format_args!("{summary}"));
        }
        if self.args.json {
            print_json(&summary)?;
        }
        match checked.disagreed {
            0 => Ok(()),
            n => Err(Failure::new(Code::Disagreed, format!("--check: {n} of {} answers are wrong", checked.checked))),
        }
    }

    /// Streams the rays through the engine into the file.
    fn answer<A: Judged>(&self, rays: RayReader) -> Result<Done<A>, Failure> {
        let total = rays.total();
        // Until the file has its name, or is gone, there is something to clean up.
        let _writing = Writing::begin();
        let hits = HitWriter::create(&self.args.output, Some(self.format), A::KIND, total, &self.kept)?;
        let progress = Progress::new("tracing", total, self.args.quiet);
        let job = Job { engine: &self.engine, samples: self.args.check };
        job.run(rays, hits, interrupt::check, |rays| progress.add(rays))
    }

    const fn scene(&self) -> &Scene {
        &self.loaded.scene.scene
    }

    /// What is to be said of rays that rounding moved.
    fn rays_rounded<A>(&self, done: &Done<A>) -> Option<String> {
        let Intersect { rays, place, .. } = self.args;
        let told = self.loaded.told(rays, done.rounding, place);
        told.filter(|_| place.rounding == OnRounding::Warn)
    }

    fn summary<A: Judged>(&self, done: &Done<A>, checked: Checked) -> Summary {
        let device = self.engine.device();
        let (rays, seconds) = (done.rays, done.seconds);
        let resolve = self.engine.resolve_seconds().min(seconds);
        let trace = seconds - resolve;
        #[expect(clippy::cast_precision_loss, reason = "a rate for people")]
        let rays_per_second = if rays > 0 { rays as f64 / seconds.max(1e-9) } else { 0.0 };
        Summary {
            device: device.name.clone(),
            driver: device.driver.clone(),
            precision: self.args.precision.name(),
            query: A::QUERY,
            scene: SceneSize::of(&self.loaded.scene),
            rays,
            hits: done.hits,
            invalid_rays: done.invalid,
            rounded_values: done.rounding.values,
            rounding: RoundingOf { scene: self.loaded.scene.rounding.into(), rays: done.rounding.into() },
            undecided: done.undecided.into(),
            seconds: Seconds {
                load: self.load,
                build: self.engine.build_seconds(),
                trace,
                resolve,
                total: self.started.elapsed().as_secs_f64(),
            },
            rays_per_second,
            checked: checked.checked,
            within_promise: checked.within_promise,
            disagreed: checked.disagreed,
            correctly_rounded: checked.correctly_rounded,
            worst_ulp: checked.worst_ulp,
            notes: device.notes.iter().chain(&self.loaded.notes).cloned().chain(self.rays_rounded(done)).collect(),
        }
    }
}
