//! Taking every figure of a report.

mod case;
mod devices;
mod distance;
mod families;
mod invariants;
mod leaks;
mod margins;
mod panels;
mod plan;
mod rivals;
mod scenes;
mod statistics;
mod subject;
mod tally;
#[cfg(test)]
pub(crate) mod tests;
mod timing;
mod truth;
mod workloads;

use std::time::{SystemTime, UNIX_EPOCH};

use rayproof::scene::{FlatHit, Ray, Scene};
use rayproof::{Device, DeviceChoice};

pub use plan::{Plan, Progress};
pub use rivals::Peers;
pub use scenes::Named;
pub use subject::{Answers, Make, Walk, engines};

use case::Asked;
use rayproof_oracle::Agreement;

use crate::model::{Oracles, Report, SCHEMA};
use rivals::Rivals;
use subject::Bench;

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A device is not there, cannot hold a scene, or fails.
    #[error(transparent)]
    Engine(#[from] rayproof::Error),
    /// A peer failed: it is left out, and the report says why.
    #[error("{0}")]
    Peer(String),
}

/// What is to be measured.
pub struct Order {
    /// How much of everything.
    pub plan: Plan,
    /// The devices; the first is what others are compared with.
    pub devices: Vec<DeviceChoice>,
    /// Scenes beside the made ones.
    pub scenes: Vec<Named>,
    /// Other people's intersectors, where they are asked for.
    pub peers: Option<Peers>,
}

/// A report in the making.
struct Run<'m> {
    plan: Plan,
    bench: Bench<'m>,
    agreement: Agreement,
    rivals: Rivals,
}

impl Run<'_> {
    /// Asks both oracles about these rays.
    fn ask(&mut self, scene: Scene, rays: Vec<Ray>) -> Asked {
        let asked = Asked::new(scene, rays);
        let hits: Vec<FlatHit> = asked.truth.iter().map(|truth| truth.hit).collect();
        self.add(rayproof_oracle::compare_hits(&asked.scene, &asked.rays, &hits));
        asked
    }

    fn add(&mut self, found: Agreement) {
        self.agreement = std::mem::take(&mut self.agreement).with(found);
    }
}

/// Measures everything, with precisions as `make` makes them: [`engines`], but for tests.
///
/// # Errors
/// When a device is not there, cannot hold a scene, or fails.
pub fn measure(order: Order, make: &Make<'_>, progress: &mut dyn Progress) -> Result<Report, Error> {
    let devices = order.devices.iter().map(Device::open).collect::<Result<Vec<_>, _>>()?;
    let mut run = Run {
        plan: order.plan,
        bench: Bench::new(devices, make)?,
        agreement: Agreement::default(),
        rivals: Rivals::new(order.peers),
    };
    let described = order.devices.iter().zip(&run.bench.devices);
    let devices = described.map(|(choice, device)| devices::describe(&run, choice, device, progress));
    let devices = devices.collect::<Result<Vec<_>, _>>()?;
    let panels = panels::measure(&mut run, progress)?;
    let distance = distance::measure(&mut run, progress)?;
    let margins = margins::measure(&mut run, progress)?;
    let families = families::measure(&mut run, progress)?;
    let leaks = leaks::measure(&mut run, progress)?;
    let invariants = invariants::measure(&mut run, progress)?;
    let mut scenes = scenes::made(&run);
    scenes.extend(order.scenes);
    let scenes = scenes::measure(&mut run, &scenes, progress)?;
    let Agreement { compared, disagreed, beyond, .. } = run.agreement;
    Ok(Report {
        schema: SCHEMA,
        rayproof: env!("CARGO_PKG_VERSION").to_owned(),
        mode: run.plan.mode.to_owned(),
        seed: run.plan.seed,
        date: today(),
        processor: processor(),
        precisions: subject::precisions(),
        devices,
        oracles: Oracles { compared, disagreed, beyond },
        panels,
        distance,
        margins,
        families,
        leaks,
        invariants,
        scenes,
        peers: run.rivals.known,
    })
}

/// The day in UTC, `2026-11-25`: days since 1970 to a date of the Gregorian calendar (Hinnant, `civil_from_days`).
fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |d| d.as_secs());
    let days = seconds / 86_400 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    // Months from March.
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let (year, month) = if month < 10 { (0, month + 3) } else { (1, month - 9) };
    format!("{}-{month:02}-{day:02}", year_of_era + era * 400 + year)
}

/// The processor's name where the system tells, and how many threads there are.
fn processor() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": ").map(|(_, name)| name));
    format!("{}, {threads} threads", name.unwrap_or(std::env::consts::ARCH))
}
