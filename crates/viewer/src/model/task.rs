//! Work that is done beside the window.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

type Work = Box<dyn FnOnce() + Send>;

/// Threads that wait for work. They are kept: what a thread has allocated is of use to its next work, and of little to others.
static IDLE: Mutex<Vec<Sender<Work>>> = Mutex::new(Vec::new());

fn idle() -> std::sync::MutexGuard<'static, Vec<Sender<Work>>> {
    IDLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does work on a thread that waits, or on a new one.
fn spawn(work: Work) {
    let waiting = idle().pop();
    let worker = waiting.unwrap_or_else(|| {
        let (sender, receiver) = channel::<Work>();
        let own = sender.clone();
        thread::spawn(move || {
            for work in receiver {
                work();
                idle().push(own.clone());
            }
        });
        sender
    });
    // A worker holds its own sender: it never hangs up.
    let _ = worker.send(work);
}

/// A result that is still to come. Dropping it drops the result.
pub(crate) struct Task<T>(Receiver<T>);

impl<T: Send + 'static> Task<T> {
    /// Starts work beside the window and asks for a repaint when it is done.
    pub(crate) fn start(repaint: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        let repaint = repaint.clone();
        spawn(Box::new(move || {
            // A panic ends the work, not the window; the sender is gone then, which `poll` tells.
            if let Ok(result) = catch_unwind(AssertUnwindSafe(work)) {
                let _ = sender.send(result);
            }
            drop(sender);
            repaint.request_repaint();
        }));
        Self(receiver)
    }

    /// The result, once it is there.
    pub(crate) fn poll(&self) -> Poll<T> {
        match self.0.try_recv() {
            Ok(result) => Poll::Done(result),
            Err(TryRecvError::Empty) => Poll::Pending,
            Err(TryRecvError::Disconnected) => Poll::Failed,
        }
    }
}

/// How far a task is.
pub(crate) enum Poll<T> {
    Pending,
    Done(T),
    /// It panicked.
    Failed,
}

/// Takes a task's result out of a slot when it is there.
pub(crate) fn take<T: Send + 'static>(slot: &mut Option<Task<T>>) -> Option<Result<T, &'static str>> {
    let result = match slot.as_ref()?.poll() {
        Poll::Pending => return None,
        Poll::Done(result) => Ok(result),
        Poll::Failed => Err("this failed in a way that should not happen; the terminal says more"),
    };
    *slot = None;
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn result<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, &'static str> {
        let mut slot = Some(Task::start(&egui::Context::default(), work));
        loop {
            if let Some(result) = take(&mut slot) {
                return result;
            }
            thread::yield_now();
        }
    }

    #[test]
    fn work_comes_back_and_a_panic_is_told() {
        assert_eq!(result(|| 7), Ok(7));
        assert!(result(|| -> u32 { panic!("on purpose") }).is_err());
        assert_eq!(result(|| 8), Ok(8));
    }
}
