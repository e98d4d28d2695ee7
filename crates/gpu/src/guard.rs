//! What a driver stack can do to the process that it is loaded into, and how far this one is kept from it.
//!
//! A panic is caught. A driver that finds no memory may also write where it must not (Mesa does, and ends the process), so
//! none is loaded where the address space left is known to be too small for any.

use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use crate::Error;

/// What a driver takes of the address space, in bytes: lavapipe 0.9 GB until its first kernel has run.
const ADDRESS_SPACE: u64 = 1 << 30;

thread_local! {
    /// Whether this thread is within [`caught`].
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    /// Where it panicked.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Runs a call into the driver stack; a panic there is an error that says what it said, and nothing on stderr.
pub(crate) fn caught<T>(call: impl FnOnce() -> T) -> Result<T, Error> {
    hush();
    let outer = GUARDED.replace(true);
    // What a panic leaves behind is wgpu's: the device is not used again but to be dropped.
    let done = panic::catch_unwind(AssertUnwindSafe(call));
    GUARDED.set(outer);
    done.map_err(|payload| {
        let said = payload.downcast_ref::<String>().map(String::as_str).or(payload.downcast_ref::<&str>().copied());
        let said = said.unwrap_or("it panicked").lines().next().unwrap_or_default();
        Error::Driver { what: format!("{said} ({})", PLACE.take()) }
    })
}

/// Has the panics of guarded threads noted instead of printed; those of others go to the hook that was there.
fn hush() {
    static ONCE: Once = Once::new();
    // A hook cannot be set by a thread that panics.
    if std::thread::panicking() {
        return;
    }
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if GUARDED.get() {
                PLACE.set(info.location().map(|place| in_its_crate(&place.to_string()).to_owned()).unwrap_or_default());
            } else {
                before(info);
            }
        }));
    });
}

/// A place from its crate's folder on.
fn in_its_crate(place: &str) -> &str {
    let before = place.rfind("/src/").and_then(|src| place[..src].rfind('/'));
    before.map_or(place, |slash| &place[slash + 1..])
}

/// Whether there is room for a driver.
///
/// # Errors
/// [`Error::OutOfMemory`] where the system tells of too little.
pub(crate) fn room_for_a_driver() -> Result<(), Error> {
    let read = |file: &str| std::fs::read_to_string(file).ok();
    let left = read("/proc/self/limits").zip(read("/proc/self/status"));
    match left.and_then(|(limits, status)| address_space_left(&limits, &status)) {
        Some(left) if left < ADDRESS_SPACE => Err(Error::OutOfMemory {
            what: format!(
                "a limit (ulimit -v) leaves {} MiB of address space, and a Vulkan driver takes up to {}",
                left >> 20,
                ADDRESS_SPACE >> 20
            ),
        }),
        _ => Ok(()),
    }
}

/// Bytes of address space that Linux's `limits` and `status` of a process leave it; none where there is no limit.
fn address_space_left(limits: &str, status: &str) -> Option<u64> {
    let field = |text: &str, name: &str| -> Option<u64> {
        text.lines().find_map(|line| line.strip_prefix(name)?.split_whitespace().next()?.parse().ok())
    };
    let most = field(limits, "Max address space")?;
    Some(most.saturating_sub(field(status, "VmSize:")? << 10))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_that_says_what_and_where() {
        let Err(Error::Driver { what }) = caught(|| -> u8 { panic!("no memory for {}", "extensions") }) else {
            panic!("a panic passes");
        };
        assert!(what.starts_with("no memory for extensions (") && what.contains("guard.rs:"), "{what}");
        assert_eq!(caught(|| 7), Ok(7));
        // Guarded no more.
        assert!(!GUARDED.get());
    }

    #[test]
    fn a_place_is_told_from_its_crate_on() {
        assert_eq!(
            in_its_crate("/home/me/registry/wgpu-hal-30.0.1/src/vulkan/adapter.rs:9:5"),
            "wgpu-hal-30.0.1/src/vulkan/adapter.rs:9:5"
        );
        assert_eq!(in_its_crate("src/main.rs:1:2"), "src/main.rs:1:2");
    }

    #[test]
    fn what_a_limit_leaves_is_read() {
        let limits = "Limit                     Soft Limit           Hard Limit           Units\n\
             Max resident set          unlimited            unlimited            bytes\n\
             Max address space         307200000            unlimited            bytes\n";
        let status = "Name:\trayproof\nVmPeak:\t  150000 kB\nVmSize:\t  100000 kB\n";
        assert_eq!(address_space_left(limits, status), Some(307_200_000 - 102_400_000));
        assert_eq!(address_space_left(&limits.replace("307200000", "unlimited"), status), None);
        assert_eq!(address_space_left(&limits.replace("307200000", "1000"), status), Some(0));
        assert_eq!(address_space_left("", ""), None);
    }
}
