//! `rayproof report`: speed against error, as a page.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayproof::{Device, DeviceChoice};
use rayproof_report::measure::{self, Named, Order, Peers, Plan, Progress, engines};
use rayproof_report::model;
use rayproof_report::page;
use rayproof_report::peers::make_venv;

use crate::args::Report;
use crate::exit::{Code, Failure, say};
use crate::target;

/// Runs the command.
pub(crate) fn run(args: &Report) -> Result<(), Failure> {
    let start = Instant::now();
    let failed =
        |e: &dyn std::fmt::Display| Failure::new(Code::Running, format!("--output: {}: {e}", args.output.display()));
    if args.output.as_os_str() == "-" || (args.output.exists() && !args.output.is_dir()) {
        return Err(Failure::new(Code::Usage, failed(&"a report is several files; give a folder").to_string()));
    }
    // A folder that cannot be made should not cost minutes.
    let make_folder = || fs::create_dir_all(&args.output).map_err(|e| failed(&e));
    let reports = if args.from.is_empty() {
        let order = order(args)?;
        make_folder()?;
        let peers = args.peers.as_deref().map(|folder| peers(folder, args.quiet));
        vec![measure::measure(Order { peers, ..order }, &engines, &mut Bar::new(args.quiet))?]
    } else {
        args.from.iter().map(|path| read(path)).collect::<Result<_, _>>()?
    };
    make_folder()?;
    let mut files = vec![
        ("report.md", page::markdown(&reports)),
        ("report.html", page::html(&reports)),
        ("plot.svg", page::plot(&reports)),
    ];
    // What is read is never written: a measurement cannot be lost to another's pages.
    if args.from.is_empty() {
        let json = serde_json::to_string_pretty(&reports[0]).map_err(|e| failed(&e))?;
        files.push(("report.json", json + "\n"));
    }
    for (name, text) in &files {
        target::replace(&args.output.join(name), |mut file| file.write_all(text.as_bytes())).map_err(|e| failed(&e))?;
    }
    if !args.quiet {
        let page = args.output.join("report.html");
        say(format_args!("report  {}, in {:.0} s", page.display(), start.elapsed().as_secs_f64()));
    }
    Ok(())
}

fn read(path: &Path) -> Result<model::Report, Failure> {
    let bad = |e: &dyn std::fmt::Display| {
        let expected = format!("give a report.json of schema {}, as `rayproof report` writes it", model::SCHEMA);
        Failure::new(Code::BadInput, format!("{}: {e}; {expected}", path.display()))
    };
    let text = fs::read_to_string(path).map_err(|e| bad(&e))?;
    let report: model::Report = serde_json::from_str(&text).map_err(|e| bad(&e))?;
    report.check().map_err(|e| bad(&e))?;
    Ok(report)
}

/// What is asked for, but the peers.
fn order(args: &Report) -> Result<Order, Failure> {
    let mut scenes = Vec::new();
    for path in &args.scene {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        scenes.push(Named { name, scene: rayproof::files::load(path)?.scene });
    }
    let plan = if args.quick { Plan::QUICK } else { Plan::FULL };
    Ok(Order { plan, devices: devices(args)?, scenes, peers: None })
}

/// The CPU engine, and what was asked for beside it; without a word a hardware GPU, if there is one.
fn devices(args: &Report) -> Result<Vec<DeviceChoice>, Failure> {
    let mut devices = vec![DeviceChoice::Cpu];
    let asked = if args.device.is_empty() { vec![DeviceChoice::Auto] } else { args.device.clone() };
    for choice in asked {
        if !Device::open(&choice)?.is_cpu() && !devices.contains(&choice) {
            devices.push(choice);
        }
    }
    Ok(devices)
}

/// The peers' virtual environment in a folder, or in the user's cache where that is empty. Without one the report goes
/// on, and says why.
fn peers(folder: &Path, quiet: bool) -> Peers {
    let python = if folder.as_os_str().is_empty() { cache() } else { Ok(folder.to_owned()) };
    let tell = |line: &str| {
        if !quiet {
            say(format_args!("peers   {line}"));
        }
    };
    let python = python.and_then(|folder| make_venv(&folder, &mut { tell }));
    if let Err(why) = &python {
        tell(&format!("Embree is not measured: {why}"));
    }
    Peers { python }
}

/// Where this user's caches are.
fn cache() -> Result<PathBuf, String> {
    let from = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let home = || from("HOME").map(|home| home.join(".cache"));
    let folder = from("XDG_CACHE_HOME").or_else(home).or_else(|| from("LOCALAPPDATA"));
    folder
        .map(|folder| folder.join("rayproof/peers"))
        .ok_or_else(|| "there is no cache folder: give --peers=VENV".to_owned())
}

/// A bar for each stage, on stderr where that is a terminal.
struct Bar {
    bar: ProgressBar,
    quiet: bool,
}

impl Bar {
    fn new(quiet: bool) -> Self {
        Self { bar: ProgressBar::hidden(), quiet }
    }
}

impl Progress for Bar {
    fn stage(&mut self, name: &str, steps: usize) {
        self.bar.finish_and_clear();
        let target = if self.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        self.bar = ProgressBar::with_draw_target(Some(steps as u64), target).with_message(name.to_owned());
        if let Ok(style) = ProgressStyle::with_template("{msg:20} [{bar:32}] {pos} of {len}, {elapsed} so far") {
            self.bar.set_style(style.progress_chars("=> "));
        }
        self.bar.tick();
    }

    fn step(&mut self) {
        self.bar.inc(1);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
