//! `rayproof-viewer`: a window onto a scene, drawn by the engines under test.

mod args;
mod window;

use std::process::ExitCode;

use clap::Parser as _;
use rayproof::Device;
pub(crate) use rayproof_viewer::{App, Failure, Look, Mode, Panel, Script, Source, Start};

#[expect(clippy::print_stderr, reason = "where no window opens, this is all there is")]
fn main() -> ExitCode {
    let cli = args::Cli::parse();
    // One core is left to the window.
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    if let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1)).build_global() {
        eprintln!("note: {error}");
    }
    let device = match Device::open(&cli.device) {
        Ok(device) => device,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::from(4);
        }
    };
    match window::open(&cli, &device) {
        Ok(None) => ExitCode::SUCCESS,
        Ok(Some(failure)) => {
            eprintln!("error: {}", failure.message);
            ExitCode::from(failure.code)
        }
        Err(why) => {
            eprintln!("error: no window could be opened:\n{why}");
            ExitCode::FAILURE
        }
    }
}
