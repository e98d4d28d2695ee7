//! The parquet crate panics on some damaged files, and a file is never a reason to crash.

use std::cell::Cell;
use std::fmt::Display;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether this thread is within [`guarded`].
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// What the parquet crate answers; a panic there is an error, and nothing on stderr.
pub(super) fn guarded<T, E: Display>(read: impl FnOnce() -> Result<T, E>) -> Result<T, String> {
    hush();
    let outer = GUARDED.replace(true);
    let done = panic::catch_unwind(AssertUnwindSafe(read));
    GUARDED.set(outer);
    match done {
        Ok(result) => result.map_err(|error| error.to_string()),
        Err(_) => Err("it is damaged".to_owned()),
    }
}

/// Panics of guarded threads are not printed; those of others go to the hook that was there.
fn hush() {
    static ONCE: Once = Once::new();
    // A hook cannot be set by a thread that panics.
    if std::thread::panicking() {
        return;
    }
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !GUARDED.get() {
                before(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_and_the_next_one_is_loud_again() {
        assert_eq!(
            guarded(|| -> Result<u8, String> { panic!("index out of bounds") }),
            Err("it is damaged".to_owned())
        );
        assert_eq!(guarded(|| Err::<u8, _>("short")), Err("short".to_owned()));
        assert_eq!(guarded(|| Ok::<_, String>(7)), Ok(7));
        assert!(!GUARDED.get());
    }
}
