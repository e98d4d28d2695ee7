//! What drivers say on stderr without being asked.
#![cfg_attr(unix, expect(unsafe_code, reason = "the environment can be changed in no other way"))]

/// Gives Mesa the folder for sockets that it complains about where there is none: on a machine without a login session.
/// Only this process sees it.
///
/// To be called before the first thread starts.
pub(crate) fn hush() {
    #[cfg(unix)]
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: main calls this first, while no other thread is there to read the environment.
        unsafe { std::env::set_var("XDG_RUNTIME_DIR", std::env::temp_dir()) };
    }
}
