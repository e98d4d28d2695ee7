//! The Python virtual environment that Embree's packages live in.

use std::io::{BufRead, BufReader, Read, Seek};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What is installed: the versions that these adaptors were written against.
const PACKAGES: [&str; 3] = ["numpy==2.4.6", "open3d==0.20.0", "embreex==4.4.0.post1"];
/// The interpreters tried, the user's own first.
const INTERPRETERS: [&str; 5] = ["python3", "python3.13", "python3.12", "python3.11", "python"];
/// The minor versions of Python 3 that all the packages have wheels for.
const MINORS: std::ops::RangeInclusive<u32> = 11..=14;
/// How much of a command's last words is told.
const TAIL: usize = 600;

/// Python's own account of which of its packages have which version.
const INSTALLED: &str = "import importlib.metadata as m
for d in m.distributions(): print(d.metadata['Name'].lower() + '==' + d.version)";

/// The interpreter of a virtual environment.
pub(super) fn python_of(venv: &Path) -> PathBuf {
    venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

/// Makes a virtual environment in `folder` with the Python packages that hold Embree, at pinned versions, and returns
/// its path; where there is one with these packages, that one. `progress` is told what is being done, a line at a time.
///
/// # Errors
/// What failed, in words: no Python of a fitting version, no module `venv`, or what pip said, such as that there is no
/// network.
pub fn make_venv(folder: &Path, progress: &mut dyn FnMut(&str)) -> Result<PathBuf, String> {
    if complete(folder) {
        progress(&format!("found {} in {}", PACKAGES.join(", "), folder.display()));
        return Ok(folder.to_owned());
    }
    let python = python_of(folder);
    // One that was half made has an interpreter: pip goes on from there.
    if !python.exists() {
        let interpreter = interpreter()?;
        progress(&format!("making a virtual environment of {interpreter} in {}", folder.display()));
        let mut command = Command::new(interpreter);
        command.args(["-m", "venv"]).arg(folder);
        run(&mut command, progress).map_err(|why| {
            let debian = if why.contains("ensurepip") { ": install the package python3-venv" } else { "" };
            format!("{interpreter} -m venv failed{debian}: {why}")
        })?;
    }
    progress(&format!("installing {}: several hundred megabytes", PACKAGES.join(", ")));
    let mut command = Command::new(&python);
    // Only wheels: building these from source takes compilers and hours.
    command.args(["-m", "pip", "install", "--disable-pip-version-check", "--no-input", "--retries", "2"]);
    command.args(["--only-binary", ":all:", "--progress-bar", "off"]).args(PACKAGES);
    run(&mut command, progress).map_err(|why| explained(&why))?;
    if complete(folder) {
        Ok(folder.to_owned())
    } else {
        Err(format!("pip installed into {}, and the packages are not there", folder.display()))
    }
}

/// Whether every package is there at its version.
fn complete(folder: &Path) -> bool {
    let output = Command::new(python_of(folder)).args(["-I", "-c", INSTALLED]).stdin(Stdio::null()).output();
    let Ok(output) = output else { return false };
    let listed = String::from_utf8_lossy(&output.stdout);
    PACKAGES.iter().all(|package| listed.lines().any(|line| line == *package))
}

/// The first interpreter of a fitting version.
fn interpreter() -> Result<&'static str, String> {
    let mut unfit = Vec::new();
    for name in INTERPRETERS {
        let version = "import sys; print(*sys.version_info[:2])";
        let output = Command::new(name).args(["-I", "-c", version]).stdin(Stdio::null()).output();
        let Ok(output) = output else { continue };
        let version = String::from_utf8_lossy(&output.stdout).trim().replace(' ', ".");
        let minor = version.strip_prefix("3.").and_then(|minor| minor.parse().ok());
        if minor.is_some_and(|minor| MINORS.contains(&minor)) {
            return Ok(name);
        }
        unfit.push(format!("{name} is {version}"));
    }
    let needed = format!("Python 3.{} to 3.{}", MINORS.start(), MINORS.end());
    if unfit.is_empty() {
        Err(format!("there is no python3: install {needed}"))
    } else {
        Err(format!("the packages need {needed}, and {}", unfit.join(", ")))
    }
}

/// Runs a command, its stdout to `progress` line by line. The error is how it ended and the end of its stderr.
fn run(command: &mut Command, progress: &mut dyn FnMut(&str)) -> Result<(), String> {
    // A file, not a second pipe: the command cannot wait for us to read it.
    let mut stderr = tempfile::tempfile().map_err(|error| format!("no temporary file: {error}"))?;
    let handle = stderr.try_clone().map_err(|error| format!("no temporary file: {error}"))?;
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(handle);
    let mut process = command.spawn().map_err(|error| error.to_string())?;
    let lines = process.stdout.take().map(|stdout| BufReader::new(stdout).lines().map_while(Result::ok));
    let mut last = String::new();
    for line in lines.into_iter().flatten() {
        progress(line.trim());
        last = line;
    }
    let status = process.wait().map_err(|error| error.to_string())?;
    if status.success() {
        return Ok(());
    }
    let mut said = Vec::new();
    let read = stderr.rewind().and_then(|()| stderr.read_to_end(&mut said));
    let said = if read.is_ok_and(|length| length > 0) { tail(&said) } else { last };
    Err(format!("{status}: {said}"))
}

fn tail(said: &[u8]) -> String {
    String::from_utf8_lossy(&said[said.len().saturating_sub(TAIL)..]).trim().to_owned()
}

/// What pip's words mean, and those of them that are errors.
fn explained(said: &str) -> String {
    let network = ["connection", "resolution", "timed out", "unreachable", "Proxy", "SSL"];
    let what = if network.iter().any(|word| said.contains(word)) {
        "pip could not reach the package index"
    } else if said.contains("No space left") {
        "the disk is full"
    } else if said.contains("No matching distribution") {
        "a package has no wheel for this Python and system"
    } else {
        "pip failed"
    };
    let errors: Vec<&str> = said.lines().filter(|line| line.starts_with("ERROR")).collect();
    format!("{what}: {}", if errors.is_empty() { said.to_owned() } else { errors.join(" ") })
}
