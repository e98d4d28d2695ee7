//! How far a run has come, on stderr where that is a terminal.

use std::fmt::Write;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

const KNOWN: &str = "{msg} [{bar:32}] {human_pos} of {human_len} rays, {mega}, {eta} left";
const UNKNOWN: &str = "{msg} {spinner} {human_pos} rays, {mega}";

/// A progress bar over rays. It disappears when dropped.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// Draws nothing if `quiet` or where stderr is not a terminal; `total` is `None` where it is not known.
    pub(crate) fn new(what: &'static str, total: Option<u64>, quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(total, target).with_message(what);
        let style = ProgressStyle::with_template(if total.is_some() { KNOWN } else { UNKNOWN });
        if let Ok(style) = style {
            bar.set_style(style.with_key("mega", mega).progress_chars("=> "));
        }
        Self(bar)
    }

    /// So many more rays are done.
    pub(crate) fn add(&self, rays: usize) {
        self.0.inc(rays as u64);
    }

    /// Runs `f`, which writes to stderr, without leaving half a bar on the screen.
    pub(crate) fn suspend<T>(&self, f: impl FnOnce() -> T) -> T {
        self.0.suspend(f)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

fn mega(state: &ProgressState, out: &mut dyn Write) {
    let _ = write!(out, "{} rays/s", crate::summary::rate(state.per_sec()));
}
