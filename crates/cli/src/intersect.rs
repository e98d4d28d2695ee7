//! `rayproof intersect`: a file of rays in, a file of answers out.

use std::path::PathBuf;
use std::time::Instant;

use rayproof::files::{Format, HitWriter, LoadedScene};
use rayproof::scene::{self, Hit, Scene};
use rayproof::{Intersector, Options, Precision};

use crate::answer::Answer;
use crate::args::Intersect;
use crate::check::{Checked, check};
use crate::choices::Query;
use crate::exit::{Code, Failure, print, say};
use crate::interrupt::Writing;
use crate::pipeline::{self, Traced};
use crate::progress::Progress;
use crate::sample::{Sample, Sampler};
use crate::source::Source;
use crate::summary::{SceneSize, Seconds, Summary, nothing_to_hit};
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
    let loading = Instant::now();
    let LoadedScene { scene, sources, .. } = rayproof::files::load(&args.scene)?;
    let load = loading.elapsed().as_secs_f64();
    target::is_no_input(&args.output, sources.iter().chain([&args.rays]).map(PathBuf::as_path))?;
    let source = Source::open(&args.rays, args.invalid.into(), args.shard)?;
    let options = Options { precision: args.precision, device: args.device.clone(), ..Options::default() };
    let engine = Intersector::new(&scene, &options)?;
    let run = Run { args, format, scene, engine, started, load };
    match args.query {
        Query::Closest => run.all::<Hit>(source),
        Query::Any => run.all::<u8>(source),
        Query::Count => run.all::<u32>(source),
    }
}

/// What is ready before the first ray is read.
struct Run<'a> {
    args: &'a Intersect,
    format: Format,
    scene: Scene,
    engine: Intersector,
    started: Instant,
    /// Seconds that loading the scene took.
    load: f64,
}

/// What is known once the file of answers is whole.
struct Done<A> {
    traced: Traced,
    hits: u64,
    invalid: u64,
    rounded: u64,
    undecided: scene::Undecided,
    samples: Vec<Sample<A>>,
}

impl Run<'_> {
    fn all<A: Answer>(&self, source: Source) -> Result<(), Failure> {
        let done = self.answer::<A>(source)?;
        let checked = check(&self.scene, &done.samples, self.args.precision, self.args.quiet);
        let summary = self.summary(&done, checked);
        if !self.args.quiet {
            say(format_args!("{summary}"));
        }
        if self.args.json {
            let json = serde_json::to_string(&summary).map_err(|e| Failure::new(Code::Running, e.to_string()))?;
            print(&json)?;
        }
        match checked.disagreed {
            0 => Ok(()),
            n => Err(Failure::new(Code::Disagreed, format!("--check: {n} of {} answers are wrong", checked.checked))),
        }
    }

    /// Streams the rays through the engine into the file.
    fn answer<A: Answer>(&self, source: Source) -> Result<Done<A>, Failure> {
        let total = source.total();
        let writing = Writing::begin();
        let mut writer = HitWriter::create(&self.args.output, Some(self.format), A::KIND, total)?;
        let mut sampler = Sampler::new(self.args.check, total);
        let mut hits = 0;
        let mut undecided = scene::Undecided::default();
        let progress = Progress::new("tracing", total, self.args.quiet);
        let (source, traced) = pipeline::run(
            source,
            Source::next,
            A::MISS,
            |rays, answers| {
                undecided += A::trace(&self.engine, rays, answers)?;
                Ok(())
            },
            |first, rays, answers| {
                A::write(&mut writer, answers)?;
                sampler.take(first, rays, answers);
                hits += answers.iter().filter(|answer| answer.is_hit()).count() as u64;
                progress.add(rays.len());
                Ok(())
            },
        )?;
        writer.finish()?;
        drop((writing, progress));
        let (invalid, rounded) = source.tally();
        Ok(Done { traced, hits, invalid, rounded, undecided, samples: sampler.finish() })
    }

    fn summary<A: Answer>(&self, done: &Done<A>, checked: Checked) -> Summary {
        let device = self.engine.device();
        let (rays, seconds) = (done.traced.rays, done.traced.seconds);
        let resolve = self.engine.resolve_seconds().min(seconds);
        let trace = seconds - resolve;
        #[expect(clippy::cast_precision_loss, reason = "a rate for people")]
        let rays_per_second = if rays > 0 { rays as f64 / seconds.max(1e-9) } else { 0.0 };
        Summary {
            device: device.name.clone(),
            driver: device.driver.clone(),
            precision: self.args.precision.name(),
            query: A::QUERY,
            scene: SceneSize::of(&self.scene),
            rays,
            hits: done.hits,
            invalid_rays: done.invalid,
            rounded_values: done.rounded,
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
            notes: device.notes.iter().cloned().chain(nothing_to_hit(&self.scene, &self.args.scene)).collect(),
        }
    }
}
