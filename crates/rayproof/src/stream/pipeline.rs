//! Read, trace, write: three threads, so that the disk and the device work at the same time.
//!
//! A handful of batches goes round and round (reader, tracer, writer, reader ...), which bounds the memory whatever
//! the number of rays.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread;
use std::time::{Duration, Instant};

use rayproof_files::Kept;
use rayproof_scene::Ray;

/// One being read, one traced, one written, and one waiting.
const BATCHES: usize = 4;

struct Batch<A> {
    /// The number of its first ray.
    first: u64,
    rays: Vec<Ray>,
    /// What the answers are to have of the rays' other columns.
    kept: Kept,
    answers: Vec<A>,
}

/// What tracing came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Traced {
    pub(super) rays: u64,
    /// From the first ray handed to the engine to the last answer back.
    pub(super) seconds: f64,
}

/// Runs the pipeline until `read` leaves a batch empty, and gives the source back.
///
/// `read` fills an empty vector from the source, and what is kept of its rays. `trace` gets rays and as many answers, all `miss`,
/// to fill. `write` gets the number of the first ray, the rays, what is kept of them and the answers. `go_on` is asked before each batch, and while the reader is waited for ten
/// times a second. The first failure of any of the four ends the run.
pub(super) fn run<S, A, E>(
    source: S,
    read: impl FnMut(&mut S, &mut Vec<Ray>, &mut Kept) -> Result<(), E> + Send + 'static,
    miss: A,
    trace: impl FnMut(&[Ray], &mut [A]) -> Result<(), E>,
    write: impl FnMut(u64, &[Ray], &Kept, &[A]) -> Result<(), E> + Send,
    go_on: impl FnMut() -> Result<(), E>,
) -> Result<(S, Traced), E>
where
    S: Send + 'static,
    A: Copy + Send + 'static,
    E: Send + 'static,
{
    let (free_in, free_out) = mpsc::sync_channel(BATCHES);
    let (read_in, read_out) = mpsc::sync_channel(BATCHES);
    let (done_in, done_out) = mpsc::sync_channel(BATCHES);
    for _ in 0..BATCHES {
        let _ = free_in.send(Batch { first: 0, rays: Vec::new(), kept: Kept::default(), answers: Vec::new() });
    }
    // Not scoped: a read from a silent stdin cannot be broken off, and must not keep an interrupted run alive.
    let reader = thread::spawn(move || read_all(source, read, &free_out, &read_in));
    let traced = thread::scope(|scope| {
        let writer = scope.spawn(move || write_all(write, &done_out, &free_in));
        let traced = trace_all(miss, trace, go_on, &read_out, done_in);
        // A failed writer hung up on the tracer: its reason is the reason.
        let written = writer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        written.and(traced)
    })?;
    let source = reader.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    Ok((source, traced))
}

fn read_all<S, A, E>(
    mut source: S,
    mut read: impl FnMut(&mut S, &mut Vec<Ray>, &mut Kept) -> Result<(), E>,
    free: &Receiver<Batch<A>>,
    out: &SyncSender<Result<Batch<A>, E>>,
) -> S {
    let mut first = 0;
    while let Ok(mut batch) = free.recv() {
        batch.rays.clear();
        batch.first = first;
        let message = read(&mut source, &mut batch.rays, &mut batch.kept).map(|()| batch);
        let last = message.as_ref().map_or(true, |batch| batch.rays.is_empty());
        first += message.as_ref().map_or(0, |batch| batch.rays.len() as u64);
        if out.send(message).is_err() || last {
            break;
        }
    }
    source
}

fn trace_all<A: Copy, E>(
    miss: A,
    mut trace: impl FnMut(&[Ray], &mut [A]) -> Result<(), E>,
    mut go_on: impl FnMut() -> Result<(), E>,
    input: &Receiver<Result<Batch<A>, E>>,
    out: SyncSender<Batch<A>>,
) -> Result<Traced, E> {
    let mut traced = Traced::default();
    let mut started = None;
    loop {
        let message = input.recv_timeout(Duration::from_millis(100));
        go_on()?;
        let mut batch = match message {
            Ok(batch) => batch?,
            Err(RecvTimeoutError::Timeout) => continue,
            // The reader panicked: joining it says so.
            Err(RecvTimeoutError::Disconnected) => break,
        };
        if batch.rays.is_empty() {
            break;
        }
        batch.answers.clear();
        batch.answers.resize(batch.rays.len(), miss);
        let started = *started.get_or_insert_with(Instant::now);
        trace(&batch.rays, &mut batch.answers)?;
        traced.seconds = started.elapsed().as_secs_f64();
        traced.rays += batch.rays.len() as u64;
        if out.send(batch).is_err() {
            break;
        }
    }
    Ok(traced)
}

fn write_all<A, E>(
    mut write: impl FnMut(u64, &[Ray], &Kept, &[A]) -> Result<(), E>,
    input: &Receiver<Batch<A>>,
    free: &SyncSender<Batch<A>>,
) -> Result<(), E> {
    while let Ok(batch) = input.recv() {
        write(batch.first, &batch.rays, &batch.kept, &batch.answers)?;
        // The reader may be through already.
        let _ = free.send(batch);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]

    use glam::Vec3;

    use super::*;

    /// The stage that failed.
    type Failure = &'static str;

    fn ray(i: u64) -> Ray {
        Ray::new(Vec3::new(i as f32, 0.0, 0.0), Vec3::X)
    }

    /// `0..total` in batches of `size`; fails at batch `fail`, counting from 0.
    fn read(
        fail: Option<u64>,
        size: u64,
        total: u64,
    ) -> impl FnMut(&mut u64, &mut Vec<Ray>, &mut Kept) -> Result<(), Failure> {
        move |next, rays, _| {
            if fail == Some(*next / size) {
                return Err("read");
            }
            rays.extend((*next..total.min(*next + size)).map(ray));
            *next += rays.len() as u64;
            Ok(())
        }
    }

    #[expect(clippy::unnecessary_wraps, reason = "as the pipeline wants it")]
    fn double(rays: &[Ray], answers: &mut [f32]) -> Result<(), Failure> {
        rays.iter().zip(answers).for_each(|(ray, answer)| *answer = 2.0 * ray.origin.x);
        Ok(())
    }

    #[expect(clippy::unnecessary_wraps, reason = "as the pipeline wants it")]
    const fn go_on() -> Result<(), Failure> {
        Ok(())
    }

    #[test]
    fn every_ray_comes_out_once_in_order_and_the_source_comes_back() {
        for total in [0, 1, 10, 1003] {
            let mut seen = Vec::new();
            let write = |first: u64, rays: &[Ray], _: &Kept, answers: &[f32]| {
                assert_eq!((first, rays.len()), (seen.len() as u64, answers.len()));
                seen.extend_from_slice(answers);
                Ok(())
            };
            let (next, traced) = run(0, read(None, 10, total), 0.0, double, write, go_on).unwrap();
            assert_eq!((next, traced.rays), (total, total));
            assert_eq!(seen, (0..total).map(|i| 2.0 * i as f32).collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_first_failure_of_any_stage_ends_the_run() {
        let write = |_: u64, _: &[Ray], _: &Kept, _: &[f32]| Ok(());
        let failure = run(0, read(Some(3), 10, 100), 0.0, double, write, go_on).unwrap_err();
        assert_eq!(failure, "read");

        let trace = |_: &[Ray], _: &mut [f32]| Err("trace");
        let failure = run(0, read(None, 10, 1000), 0.0, trace, write, go_on).unwrap_err();
        assert_eq!(failure, "trace");

        let write = |first: u64, _: &[Ray], _: &Kept, _: &[f32]| match first {
            50 => Err("write"),
            _ => Ok(()),
        };
        let failure = run(0, read(None, 10, 1000), 0.0, double, write, go_on).unwrap_err();
        assert_eq!(failure, "write");
    }

    #[test]
    fn a_run_that_is_cancelled_ends_between_batches_and_does_not_wait_for_a_silent_source() {
        let write = |_: u64, _: &[Ray], _: &Kept, _: &[f32]| Ok(());
        let mut batches = 0;
        let stop = || {
            batches += 1;
            if batches > 3 { Err("cancelled") } else { Ok(()) }
        };
        let mut traced = 0;
        let trace = |rays: &[Ray], answers: &mut [f32]| {
            traced += rays.len();
            double(rays, answers)
        };
        assert_eq!(run(0, read(None, 10, 1000), 0.0, trace, write, stop).unwrap_err(), "cancelled");
        assert_eq!(traced, 30);

        let (_silent, wait) = mpsc::channel::<()>();
        let silent = move |_: &mut u64, _: &mut Vec<Ray>, _: &mut Kept| wait.recv().map_err(|_| "hung up");
        assert_eq!(run(0, silent, 0.0, double, write, || Err("cancelled")).unwrap_err(), "cancelled");
    }
}
