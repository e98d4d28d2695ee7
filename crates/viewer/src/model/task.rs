//! Work that is done beside the window.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

/// A result that is still to come. Dropping it drops the result.
pub(crate) struct Task<T>(Receiver<T>);

impl<T: Send + 'static> Task<T> {
    /// Starts work on a thread of its own and asks for a repaint when it is done.
    pub(crate) fn start(repaint: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        let repaint = repaint.clone();
        thread::spawn(move || {
            // A panic ends the work, not the window; the sender is gone then, which `poll` tells.
            if let Ok(result) = catch_unwind(AssertUnwindSafe(work)) {
                let _ = sender.send(result);
            }
            drop(sender);
            repaint.request_repaint();
        });
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
