//! `rayproof`: shoot rays at a scene from the command line, and learn how far each answer can be trusted.

mod args;
mod check;
mod choices;
mod devices;
mod exit;
mod info;
mod interrupt;
mod intersect;
mod judged;
mod legend;
mod load;
mod parse;
mod picture;
mod progress;
mod quiet;
mod rays;
mod render;
mod report;
mod summary;
mod target;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    quiet::hush();
    let started = std::time::Instant::now();
    let cli = args::Cli::parse();
    interrupt::install();
    let done = match &cli.command {
        args::Command::Intersect(args) => intersect::run(args, started),
        args::Command::Rays(args) => rays::run(args),
        args::Command::Render(args) => render::run(args),
        args::Command::Info(args) => info::run(args),
        args::Command::Devices(args) => devices::run(args),
        args::Command::Report(args) => report::run(args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
