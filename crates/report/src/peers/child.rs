//! One child process that answers batches of rays: files in a folder, a line each way.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child as Process, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use serde::Deserialize;
use tempfile::TempDir;

/// How long one request may take: a child that says nothing for longer hangs.
const PATIENCE: Duration = Duration::from_secs(600);
/// How much of what a dead child wrote to stderr is told.
const TAIL: usize = 400;

/// What a child says once it is ready, and after each request.
#[derive(Debug, Deserialize)]
struct Line {
    #[serde(default)]
    seconds: f64,
    #[serde(default)]
    version: String,
    error: Option<String>,
}

/// A running child. It ends when this does.
pub(super) struct Child {
    process: Process,
    requests: ChildStdin,
    lines: Receiver<String>,
    folder: TempDir,
    /// What it said of itself.
    pub(super) version: String,
    /// How long it took to be ready for rays.
    pub(super) build_seconds: f64,
}

impl Child {
    /// Starts `script` by `python` with these arguments and, after them, a new folder of these files; waits until it is
    /// ready.
    pub(super) fn start(
        python: &Path,
        script: &str,
        arguments: &[&str],
        files: &[(&str, &[u8])],
    ) -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder: {error}"))?;
        let path = |name: &str| folder.path().join(name);
        for (name, bytes) in files.iter().chain(&[("script.py", script.as_bytes())]) {
            write(&path(name), bytes)?;
        }
        // A file, not a pipe: nobody has to read it for the child to go on.
        let stderr = File::create(path("stderr")).map_err(|error| format!("no temporary file: {error}"))?;
        // -I: no modules from this user's folders or environment.
        let script = path("script.py");
        let mut command = Command::new(python);
        command.args([OsStr::new("-I"), script.as_os_str()]).args(arguments).arg(folder.path());
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(stderr);
        let mut process = command.spawn().map_err(|error| format!("{}: {error}", python.display()))?;
        let (Some(requests), Some(stdout)) = (process.stdin.take(), process.stdout.take()) else {
            return Err("the child has no pipes".to_owned());
        };
        let (sender, lines) = mpsc::channel();
        thread::spawn(move || {
            // Ends with the child, whose end closes the pipe, or when nobody listens any more.
            BufReader::new(stdout).lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
        let mut child = Self { process, requests, lines, folder, version: String::new(), build_seconds: 0.0 };
        let ready = child.wait()?;
        (child.version, child.build_seconds) = (ready.version, ready.seconds);
        Ok(child)
    }

    /// Asks about a file `rays` and reads `answers`, which must fit. Returns the seconds that the child measured.
    pub(super) fn ask(&mut self, query: &str, rays: &[u8], answers: &mut [u8]) -> Result<f64, String> {
        write(&self.path("rays"), rays)?;
        // Where the child has died, the line cannot be written, and waiting says why.
        let _ = writeln!(self.requests, "{query}").and_then(|()| self.requests.flush());
        let line = self.wait()?;
        let path = self.path("answers");
        let mut file = File::open(&path).map_err(|error| format!("no answers: {error}"))?;
        let length = file.metadata().map_or(0, |data| data.len());
        if length != answers.len() as u64 {
            return Err(format!("{length} bytes of answers instead of {}", answers.len()));
        }
        file.read_exact(answers).map_err(|error| format!("answers: {error}"))?;
        Ok(line.seconds)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn wait(&mut self) -> Result<Line, String> {
        let line = match self.lines.recv_timeout(PATIENCE) {
            Ok(line) => line,
            Err(RecvTimeoutError::Timeout) => return Err(self.dead(&format!("no answer in {} s", PATIENCE.as_secs()))),
            Err(RecvTimeoutError::Disconnected) => {
                // It may close its stdout a little before it ends: a kill then would hide how it ended.
                let ended = |process: &mut Process| process.try_wait().is_ok_and(|status| status.is_some());
                for _ in 0..100 {
                    if ended(&mut self.process) {
                        break;
                    }
                    thread::sleep(Duration::from_millis(10));
                }
                return Err(self.dead("it ended"));
            }
        };
        let line: Line = serde_json::from_str(&line).map_err(|error| format!("it said {line:?}: {error}"))?;
        if let Some(error) = line.error { Err(error) } else { Ok(line) }
    }

    /// Ends the child and says how and with what last words.
    fn dead(&mut self, why: &str) -> String {
        let _ = self.process.kill();
        let status = self.process.wait().map_or_else(|error| error.to_string(), |status| status.to_string());
        let said = fs::read(self.path("stderr")).unwrap_or_default();
        let said = String::from_utf8_lossy(&said[said.len().saturating_sub(TAIL)..]).trim().to_owned();
        let words = if said.is_empty() { "it said nothing".to_owned() } else { format!("it said: {said}") };
        format!("{why} ({status}); {words}")
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        // Nothing to do where it has ended already.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}
