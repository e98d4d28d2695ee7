use rayproof_files::{self as files, HitWriter, RayReader, Rounding};
use rayproof_scene::Undecided;

use super::Answer;
use super::pipeline;
use super::sample::{Sample, Sampler};
use crate::batch::BATCH;
use crate::{Error, Intersector};

/// What is to be asked, and what to keep of the answers.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// Who answers.
    pub engine: &'a Intersector,
    /// How many rays are kept with their answers for a [`check`](super::check()), spread evenly over the table; fewer where it has
    /// fewer.
    pub samples: u64,
}

/// What a job came to.
#[derive(Clone, Debug)]
pub struct Done<A> {
    /// How many rays were answered.
    pub rays: u64,
    /// How many of them hit something.
    pub hits: u64,
    /// How many were bad, and taken as misses.
    pub invalid: u64,
    /// What rounding the rays' numbers to `f32` changed.
    pub rounding: Rounding,
    /// How many rays the stages of the precision `exact` left open.
    pub undecided: Undecided,
    /// From the first ray handed to the engine to the last answer back.
    pub seconds: f64,
    /// What was kept, in the rays' order.
    pub samples: Vec<Sample<A>>,
}

impl Job<'_> {
    /// Answers every ray of a table into a file of hits, which then takes its name.
    ///
    /// `go_on` is asked before each batch and ten times a second while there is none to trace: its error ends the job. `progress`
    /// hears how many more rays are written. On an error the file does not appear; a read that is under way, of a silent pipe
    /// say, is left to itself.
    ///
    /// # Errors
    /// The first of: reading fails or a ray is bad, tracing fails, writing fails, `go_on` says no.
    ///
    /// # Panics
    /// When `hits` is for another kind of answer.
    pub fn run<A: Answer, E>(
        &self,
        rays: RayReader,
        mut hits: HitWriter,
        go_on: impl FnMut() -> Result<(), E>,
        mut progress: impl FnMut(usize) + Send,
    ) -> Result<Done<A>, E>
    where
        E: From<Error> + From<files::Error> + Send + 'static,
    {
        let mut sampler = Sampler::new(self.samples, rays.total());
        let mut hit = 0;
        let mut undecided = Undecided::default();
        let (rays, traced) = pipeline::run(
            rays,
            |reader, rays, kept| {
                reader.next_batch(rays, BATCH)?;
                reader.take_kept(kept);
                Ok(())
            },
            A::MISS,
            |rays, answers| {
                undecided += A::trace(self.engine, rays, answers)?;
                Ok(())
            },
            |first, rays, kept, answers| {
                A::write(&mut hits, answers, kept)?;
                sampler.take(first, rays, answers);
                hit += answers.iter().filter(|answer| answer.is_hit()).count() as u64;
                progress(rays.len());
                Ok(())
            },
            go_on,
        )?;
        hits.finish()?;
        Ok(Done {
            rays: traced.rays,
            hits: hit,
            invalid: rays.invalid(),
            rounding: rays.rounding(),
            undecided,
            seconds: traced.seconds,
            samples: sampler.finish(),
        })
    }
}
