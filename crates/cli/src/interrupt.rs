//! Ctrl-C and `kill`: a run that is writing winds down and removes its temporary file; any other stops at once.

use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::time::Duration;

use crate::exit::{Code, Failure};

static WRITING: AtomicBool = AtomicBool::new(false);
/// What a batch may still take. A driver that compiles, and a pipe that nobody reads, can take for ever.
const GRACE: Duration = Duration::from_secs(5);

/// The first signal that came, 0 before.
static SIGNAL: AtomicI32 = AtomicI32::new(0);

/// Listens for SIGINT and SIGTERM; SIGHUP stays as `nohup` may have set it. Where that cannot be had, the system's own
/// way stands: the process ends, and what stays behind is a temporary file, never the output.
pub(crate) fn install() {
    #[cfg(unix)]
    {
        use signal_hook::consts::{SIGINT, SIGTERM};
        if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) {
            std::thread::spawn(move || signals.forever().for_each(caught));
        }
    }
}

#[cfg(unix)]
fn caught(signal: i32) {
    let again = SIGNAL.swap(signal, Ordering::SeqCst) != 0;
    if again || !WRITING.load(Ordering::SeqCst) {
        std::process::exit(code(signal) as i32);
    }
    std::thread::spawn(move || {
        std::thread::sleep(GRACE);
        std::process::exit(code(signal) as i32);
    });
}

/// 128 and the signal's number, as shells have it.
const fn code(signal: i32) -> Code {
    if signal == 15 { Code::Terminated } else { Code::Interrupted }
}

/// While this lives there is something to clean up, and the loops ask [`check`].
pub(crate) struct Writing;

impl Writing {
    pub(crate) fn begin() -> Self {
        WRITING.store(true, Ordering::SeqCst);
        Self
    }
}

impl Drop for Writing {
    fn drop(&mut self) {
        WRITING.store(false, Ordering::SeqCst);
    }
}

/// Fails when someone asked the run to stop.
pub(crate) fn check() -> Result<(), Failure> {
    match SIGNAL.load(Ordering::SeqCst) {
        0 => Ok(()),
        signal => Err(Failure::new(code(signal), "interrupted")),
    }
}
