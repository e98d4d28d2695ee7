//! What a run came to: a JSON object for scripts, a few lines for people.

use std::fmt::{self, Write as _};

use rayproof::DeviceInfo;
use rayproof::files::{LoadedScene, Rounding};
use rayproof::scene::{self, Kind};
pub(crate) use rayproof_report::page::count as grouped;
use serde::Serialize;

/// The object that `--json` prints. Its names are a contract.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Summary {
    pub(crate) device: String,
    pub(crate) driver: String,
    pub(crate) precision: &'static str,
    pub(crate) query: &'static str,
    pub(crate) scene: SceneSize,
    pub(crate) rays: u64,
    pub(crate) hits: u64,
    pub(crate) invalid_rays: u64,
    pub(crate) rounded_values: u64,
    pub(crate) undecided: Undecided,
    pub(crate) seconds: Seconds,
    pub(crate) rays_per_second: f64,
    pub(crate) checked: u64,
    pub(crate) within_promise: u64,
    pub(crate) disagreed: u64,
    pub(crate) correctly_rounded: u64,
    pub(crate) worst_ulp: Option<u64>,
    pub(crate) rounding: RoundingOf,
    pub(crate) notes: Vec<String>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct SceneSize {
    pub(crate) spheres: usize,
    pub(crate) triangles: usize,
    pub(crate) geometries: usize,
    pub(crate) rounded_values: u64,
    pub(crate) largest_shift: f64,
    pub(crate) flattened_triangles: u64,
}

/// What rounding to `f32` changed.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct RoundingOf {
    pub(crate) scene: Rounded,
    pub(crate) rays: Rounded,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Rounded {
    pub(crate) values: u64,
    pub(crate) largest_shift: f64,
}

impl From<Rounding> for Rounded {
    fn from(Rounding { values, largest_shift, .. }: Rounding) -> Self {
        Self { values, largest_shift }
    }
}

impl SceneSize {
    pub(crate) fn of(LoadedScene { scene, rounding, .. }: &LoadedScene) -> Self {
        let mut size = Self {
            spheres: 0,
            triangles: 0,
            geometries: scene.geometries().len(),
            rounded_values: rounding.values,
            largest_shift: rounding.largest_shift,
            flattened_triangles: rounding.flattened_triangles,
        };
        for kind in Kind::ALL {
            match kind {
                Kind::Triangle => size.triangles = scene.count(kind),
                Kind::Sphere => size.spheres = scene.count(kind),
            }
        }
        size
    }
}

/// How many rays each stage of the cascade left open; all 0 in the precisions without one. A ray whose answer the first stage
/// settled may still have a number that double width cannot round.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Undecided {
    /// The word that scripts know.
    #[serde(rename = "first_tier")]
    pub(crate) first_stage: u64,
    pub(crate) after_refine: u64,
    pub(crate) resolved_on_cpu: u64,
}

impl From<scene::Undecided> for Undecided {
    fn from(scene::Undecided { first_stage, after_refine, resolved_on_cpu }: scene::Undecided) -> Self {
        Self { first_stage, after_refine, resolved_on_cpu }
    }
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Seconds {
    pub(crate) load: f64,
    pub(crate) build: f64,
    pub(crate) trace: f64,
    pub(crate) resolve: f64,
    pub(crate) total: f64,
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", device(&self.device, &self.driver, &self.notes))?;
        writeln!(f, "scene   {}", self.scene)?;
        let (rays, hits) = (grouped(self.rays), grouped(self.hits));
        write!(f, "rays    {rays} ({}, {}), {hits} hit", self.query, self.precision)?;
        if self.invalid_rays > 0 {
            write!(f, ", {} invalid taken as misses", grouped(self.invalid_rays))?;
        }
        if self.rounded_values > 0 {
            write!(f, ", {} values rounded to f32", grouped(self.rounded_values))?;
        }
        if self.precision == "exact" {
            let [open, last] = [self.undecided.first_stage, self.undecided.resolved_on_cpu].map(grouped);
            write!(f, "\nopen    {open} answers after f32; {last} answers or roundings left to exact arithmetic")?;
        }
        let Seconds { load, build, trace, resolve, total } = self.seconds;
        let rate = rate(self.rays_per_second);
        write!(f, "\ntime    {total:.2} s: load {load:.2}, build {build:.2}, trace {trace:.2}")?;
        if resolve > 0.0 {
            write!(f, ", resolve {resolve:.2}")?;
        }
        write!(f, " ({rate} rays/s)")?;
        if self.checked > 0 {
            self.check(f)?;
        }
        Ok(())
    }
}

impl Summary {
    /// What `--check` counted: the parts add up to the whole.
    fn check(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let off = self.checked - self.correctly_rounded - self.within_promise - self.disagreed;
        let [checked, right, off, within, wrong] =
            [self.checked, self.correctly_rounded, off, self.within_promise, self.disagreed].map(grouped);
        write!(f, "\ncheck   {checked} rays against exact arithmetic: {wrong} disagree\n        ")?;
        let Some(worst) = self.worst_ulp else {
            return write!(f, "{right} are exact\n        {within} differ within the promise");
        };
        let worst = grouped(worst);
        write!(f, "{right} are exact: a miss, or the primitive with t correctly rounded\n        ")?;
        write!(f, "{off} have the exact primitive and t off, by {worst} ULP at worst\n        ")?;
        write!(f, "{within} differ within the promise")
    }
}

impl fmt::Display for SceneSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { triangles, spheres, geometries, .. } = *self;
        for (count, kind) in [(triangles, Kind::Triangle), (spheres, Kind::Sphere)].into_iter().filter(|(n, _)| *n > 0)
        {
            write!(f, "{} {}{}, ", grouped(count as u64), kind.name(), if count == 1 { "" } else { "s" })?;
        }
        write!(f, "{geometries} geometr{}", if geometries == 1 { "y" } else { "ies" })?;
        match self.rounded_values {
            0 => Ok(()),
            n => write!(f, "; {} values rounded to f32, by {:.1e} at most", grouped(n), self.largest_shift),
        }
    }
}

/// The lines that say what ran.
pub(crate) fn device_lines(info: &DeviceInfo, more: &[String]) -> String {
    let notes: Vec<String> = info.notes.iter().chain(more).cloned().collect();
    device(&info.name, &info.driver, &notes)
}

fn device(name: &str, driver: &str, notes: &[String]) -> String {
    let mut text = format!("device  {name}; driver {driver}\n");
    for note in notes {
        let _ = writeln!(text, "note    {note}");
    }
    text
}

/// `12345678.9` as `12.3 M`.
pub(crate) fn rate(per_second: f64) -> String {
    match per_second {
        r if r >= 1e9 => format!("{:.2} G", r / 1e9),
        r if r >= 1e6 => format!("{:.1} M", r / 1e6),
        r if r >= 1e3 => format!("{:.1} k", r / 1e3),
        r => format!("{r:.0}"),
    }
}
