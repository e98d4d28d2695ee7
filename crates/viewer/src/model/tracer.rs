//! The thread that makes pictures: the newest wish first, and what was wanted before is given up.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Instant;

use super::job::Job;
use super::judge::Judge;
use super::view::{Picture, View};

/// Answers views, the newest wish first.
pub(crate) struct Tracer {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

pub(super) struct Shared {
    wish: Mutex<Wish>,
    bell: Condvar,
    pub(super) newest: AtomicU64,
    /// Whether the oracle rests.
    pub(super) rests: AtomicBool,
    picture: Mutex<Picture>,
    pub(super) repaint: Box<dyn Fn() + Send + Sync>,
}

#[derive(Default)]
struct Wish {
    view: Option<(View, Instant)>,
    quit: bool,
}

impl Shared {
    /// The picture, to be looked at or replaced.
    pub(super) fn picture(&self) -> MutexGuard<'_, Picture> {
        lock(&self.picture)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Tracer {
    /// Starts the thread; it calls `repaint` whenever the picture has changed.
    pub(crate) fn new(repaint: impl Fn() + Send + Sync + 'static) -> Self {
        let shared = Arc::new(Shared {
            wish: Mutex::default(),
            bell: Condvar::new(),
            newest: AtomicU64::new(0),
            rests: AtomicBool::new(false),
            picture: Mutex::default(),
            repaint: Box::new(repaint),
        });
        let worker = shared.clone();
        Self { shared, thread: Some(thread::spawn(move || work(&worker))) }
    }

    /// Wants a view; what was wanted before is given up. Returned is its number.
    pub(crate) fn show(&self, view: View) -> u64 {
        let mut wish = lock(&self.shared.wish);
        let number = self.shared.newest.fetch_add(1, Ordering::Relaxed) + 1;
        wish.view = Some((view, Instant::now()));
        self.shared.bell.notify_one();
        number
    }

    /// Lets the oracle rest, or go on: what is measured meanwhile should have the cores to itself.
    pub(crate) fn rest(&self, rests: bool) {
        self.shared.rests.store(rests, Ordering::Relaxed);
    }

    /// The picture, while it is looked at.
    pub(crate) fn picture(&self) -> MutexGuard<'_, Picture> {
        self.shared.picture()
    }
}

impl Drop for Tracer {
    fn drop(&mut self) {
        lock(&self.shared.wish).quit = true;
        self.shared.newest.fetch_add(1, Ordering::Relaxed);
        self.shared.bell.notify_one();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Waits for wishes and grants them, until the viewer ends.
fn work(shared: &Shared) {
    let mut kept: Option<Job<'_>> = None;
    loop {
        let (view, since, number) = {
            let mut wish = lock(&shared.wish);
            loop {
                if wish.quit {
                    return;
                }
                if let Some((view, since)) = wish.view.take() {
                    break (view, since, shared.newest.load(Ordering::Relaxed));
                }
                wish = shared.bell.wait(wish).unwrap_or_else(PoisonError::into_inner);
            }
        };
        // Answers to the same rays stay, whatever is made of them.
        let layers = match kept.take() {
            Some(job) if job.view.same_rays(&view) => (job.layers, job.judge),
            _ => (HashMap::new(), Judge::default()),
        };
        let mut job = Job::new(shared, view, number, since, layers);
        // A panic in an engine must not leave the window without pictures for good.
        let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| job.run()));
        match done {
            Ok(Ok(())) => {}
            Ok(Err(error)) => job.fail(error.to_string()),
            Err(_) => job.fail("the engine failed in a way that should not happen; the terminal says more".to_owned()),
        }
        kept = Some(job);
    }
}
