//! Why a command stopped, and the exit code that says so.

use std::fmt;
use std::io::Write as _;
use std::process::ExitCode;

use rayproof::stream::ShardError;
use rayproof::{DeviceError, files};
use serde::Serialize;

/// The exit codes that scripts rely on; 0 is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Code {
    /// Failed while running: device lost, disk full, out of memory.
    Running = 1,
    /// The command line asks for what cannot be.
    Usage = 2,
    /// `--check` found a disagreement.
    Disagreed = 3,
    /// The device asked for is not there.
    NoDevice = 4,
    /// The input is bad.
    BadInput = 5,
    /// Stopped by Ctrl-C: 128 and the number of SIGINT.
    Interrupted = 130,
    /// Stopped by `kill`: 128 and the number of SIGTERM.
    Terminated = 143,
}

/// A command that did not get to its end.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) code: Code,
    message: String,
}

impl Failure {
    pub(crate) fn new(code: Code, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }

    /// Says on stderr what happened and gives the exit code.
    pub(crate) fn report(&self) -> ExitCode {
        say(format_args!("error: {}", self.message));
        ExitCode::from(self.code as u8)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl From<files::Error> for Failure {
    fn from(error: files::Error) -> Self {
        let code = match &error {
            files::Error::Bad(_) | files::Error::Open { .. } => Code::BadInput,
            _ => Code::Running,
        };
        Self::new(code, error.to_string())
    }
}

impl From<ShardError> for Failure {
    fn from(error: ShardError) -> Self {
        match error {
            ShardError::File(error) => error.into(),
            other => Self::new(Code::Usage, format!("--shard: {other}")),
        }
    }
}

impl From<rayproof_report::measure::Error> for Failure {
    fn from(error: rayproof_report::measure::Error) -> Self {
        match error {
            rayproof_report::measure::Error::Engine(error) => error.into(),
            other => Self::new(Code::Running, other.to_string()),
        }
    }
}

impl From<rayproof::Error> for Failure {
    fn from(error: rayproof::Error) -> Self {
        let code = match &error {
            rayproof::Error::Device(DeviceError::NoAdapter { .. }) => Code::NoDevice,
            rayproof::Error::NotExact | rayproof::Error::OnDevice => Code::Usage,
            rayproof::Error::InvalidRay { .. } => Code::BadInput,
            _ => Code::Running,
        };
        Self::new(code, error.to_string())
    }
}

/// A line on stderr. A closed stderr is no reason to stop.
pub(crate) fn say(line: fmt::Arguments<'_>) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// A line on stdout.
///
/// # Errors
/// When stdout is closed or full.
pub(crate) fn print(line: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{line}").and_then(|()| out.flush()).map_err(|e| Failure::new(Code::Running, format!("stdout: {e}")))
}

/// An object of JSON on stdout, in one line.
///
/// # Errors
/// As [`print`].
pub(crate) fn print_json(object: &impl Serialize) -> Result<(), Failure> {
    print(&serde_json::to_string(object).map_err(|e| Failure::new(Code::Running, e.to_string()))?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_error_has_the_code_of_the_contract() {
        let io = || std::io::Error::from(std::io::ErrorKind::NotFound);
        let path = || std::path::PathBuf::from("x");
        let device = rayproof::Error::Device;
        let cases = [
            (Failure::from(files::Error::bad("x", "row 1", "is bad", "make it good")), 5),
            (Failure::from(files::Error::Open { path: path(), source: io() }), 5),
            (Failure::from(files::Error::Io { path: path(), source: io() }), 1),
            (Failure::from(device(DeviceError::NoAdapter { wanted: "a GPU".into(), there: "none".into() })), 4),
            (Failure::from(device(DeviceError::Unsupported { what: "no f64".into() })), 1),
            (Failure::from(device(DeviceError::Lost { why: "unplugged".into() })), 1),
            (Failure::from(device(DeviceError::OutOfMemory { what: "hits".into() })), 1),
            (Failure::from(rayproof::Error::TooLarge(rayproof::TooLarge { primitives: 1 })), 1),
            (Failure::new(Code::Usage, "no"), 2),
            (Failure::new(Code::Disagreed, "no"), 3),
        ];
        for (failure, code) in cases {
            assert_eq!(failure.code as u8, code, "{failure}");
        }
    }
}
