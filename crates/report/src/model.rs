//! What a report holds: every number that the page shows, and nothing that a second run would not find again but
//! [`Timing`]s.
//!
//! This is `report.json`. [`SCHEMA`] changes when a name or a meaning does: there a precision is called a method still.

use serde::{Deserialize, Serialize};

/// The version of this layout.
pub const SCHEMA: u32 = 1;

/// One run of the command `rayproof report`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The version of rayproof.
    pub rayproof: String,
    /// `quick` or `full`.
    pub mode: String,
    /// What all random numbers start from.
    pub seed: u64,
    /// The day in UTC, `2026-11-25`.
    pub date: String,
    /// The processor's name and how many threads ran.
    pub processor: String,
    /// The precisions that were measured, in the order in which pages show them.
    #[serde(rename = "methods")]
    pub precisions: Vec<Formulas>,
    /// What ran them; rows below name a device by its place here.
    pub devices: Vec<Device>,
    /// How the two oracles agreed.
    pub oracles: Oracles,
    /// Speed against error, one primitive kind and workload a panel.
    pub panels: Vec<Panel>,
    /// Error and lost hits against distance over radius.
    pub distance: Vec<DistanceCurve>,
    /// Wrong verdicts against the distance from the silhouette or the edge.
    pub margins: Vec<MarginCurve>,
    /// The 42 families.
    pub families: Vec<Family>,
    /// Rays at vertices and edges from inside closed meshes.
    pub leaks: Vec<Leaks>,
    /// What must not change an answer, and did or did not.
    pub invariants: Vec<Invariant>,
    /// Whole scenes: millions of rays a second, and the error of the same rays.
    pub scenes: Vec<SceneRow>,
    /// Other people's intersectors.
    pub peers: Vec<Peer>,
}

impl Report {
    /// Whether rows name devices that are there, and what there is to say if not.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check(&self) -> Result<(), String> {
        if self.schema != SCHEMA {
            return Err(format!("its schema is {}", self.schema));
        }
        let panels = self.panels.iter().flat_map(|p| &p.points).map(|p| p.device);
        let curves = self.distance.iter().map(|c| c.device).chain(self.margins.iter().map(|c| c.device));
        let families = self.families.iter().flat_map(|f| &f.rows).map(|r| r.device);
        let mut all = panels.chain(curves).chain(families).chain(self.invariants.iter().map(|i| i.device));
        match all.find(|&device| device >= self.devices.len()) {
            Some(device) => Err(format!("a row names device {device}, and it has {}", self.devices.len())),
            None => Ok(()),
        }
    }
}

/// A precision, and by which formulas it computes a hit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Formulas {
    /// One word, as `--precision` takes it: `textbook`, `classic`, `fast`, `pair`, `double`, `exact`.
    pub id: String,
    /// What it does to spheres, in a few words.
    pub sphere: String,
    /// What it does to triangles; empty where those are another precision's.
    pub triangle: String,
}

/// What ran.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// The adapter's name, or `CPU engine, 2 threads`.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// `CPU engine`, `software adapter` or `hardware GPU`.
    pub kind: String,
    /// Notes of the device, such as that its bits may differ.
    pub notes: Vec<String>,
    /// Its arithmetic, measured, a row for each route by which kernels reach it; none for the CPU engine.
    pub arithmetic: Vec<Arithmetic>,
    /// What exact `f32` rules cost; none for the CPU engine.
    pub rules: Vec<Rule>,
}

/// How often operations differed from IEEE 754's answers. Zero everywhere is IEEE.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arithmetic {
    /// `SPIR-V with NoContraction` or `plain WGSL`.
    pub route: String,
    /// Pairs of numbers tried.
    pub pairs: u64,
    /// Each operation's name and how many results were not IEEE's.
    pub wrong: Vec<(String, u64)>,
    /// Whether `fma` is fused.
    pub fma_fused: bool,
    /// Whether kernels give the CPU's bits.
    pub ieee: bool,
}

/// A kernel under other rules than its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// Such as `NoContraction`, `free to contract`, `plain WGSL, checked`.
    pub rules: String,
    /// The workload.
    pub workload: String,
    /// Rays whose answer's bits differ from those of exact rules.
    pub different: u64,
    /// Of how many.
    pub rays: u64,
    /// Nanoseconds a ray, the kernel alone; the unit of every `Timing` is its field's.
    pub ns_per_ray: Timing,
    /// This over that of exact rules, by rounds.
    pub ratio: Timing,
}

/// Repeated measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// How many.
    pub runs: u32,
    /// The 5th percentile.
    pub p5: f64,
    /// The median.
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

/// A distribution of errors. All zero where `n` is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantiles {
    /// How many.
    pub n: u64,
    /// The median.
    pub p50: f64,
    /// The 90th percentile.
    pub p90: f64,
    /// The 99th.
    pub p99: f64,
    /// The 99.9th: the largest where there are fewer than a thousand.
    pub p999: f64,
    /// The largest.
    pub max: f64,
}

/// How often something happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rate {
    /// How often.
    pub count: u64,
    /// Of how many.
    pub of: u64,
    /// No more than this share, with 95 % confidence (Clopper and Pearson 1934, one-sided): about `3 / of` for none. 1
    /// where `of` is 0.
    pub bound: f64,
}

/// A precision's answers against the exact ones.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Errors {
    /// Rays asked.
    pub rays: u64,
    /// Missed, of those that hit.
    pub misses: Rate,
    /// Hit, of those that miss.
    pub false_hits: Rate,
    /// Another primitive, of those that hit and are hit.
    pub wrong_primitive: Rate,
    /// Any of the three, of all rays: misclassified.
    pub wrong: Rate,
    /// `|t - t*|` in units of the last place of `t*`, where the primitive is right. 0.5 is what rounding costs.
    pub t: Quantiles,
    /// The errors of `u`, on triangles.
    pub u: Quantiles,
    /// The errors of `v`, on triangles.
    pub v: Quantiles,
    /// The error of `t` over what rounding every input and the result may do: `|t - t*| / (|t*| kappa u + ulp(t*) / 2)`, with
    /// `u = 2^-24`. A few: the precision is as good as its numbers; much more: it is the precision. Rays along the surface are left out.
    pub normalised: Quantiles,
    /// What is left of the primitive's equation at the answer's point: `| |p - c|^2 - r^2 | / r^2` of a sphere, the
    /// distance from the plane over the triangle's size.
    pub residual: Quantiles,
    /// The distance of `e + t d` from `a + u (b - a) + v (c - a)` over the triangle's size; for triangles.
    pub gap: Quantiles,
    /// The ray with the largest error of `t`.
    pub worst: Option<Case>,
    /// The first misclassified ray.
    pub first_wrong: Option<Case>,
}

/// One ray that `rayproof intersect` can answer again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// The scene file, TOML; numbers are hexadecimal floats.
    pub scene: String,
    /// The ray file, CSV.
    pub rays: String,
    /// The exact answer in words, such as `hit 0, t = 0x1.8p+3 (12)` or `miss`.
    pub exact: String,
    /// The precision's.
    pub answer: String,
    /// The error of `t` in ULP, where both hit the same primitive.
    pub ulp: Option<f64>,
    /// Whether the precision gives the same answer to these two files as it gave in the larger scene.
    pub replays: bool,
}

/// Which stage of the cascade decided.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Decided {
    /// Rays.
    pub rays: u64,
    /// In `f32`.
    pub first: u64,
    /// In wider numbers.
    pub refined: u64,
    /// In exact arithmetic.
    pub resolved: u64,
}

/// Speed against error on one workload.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Panel {
    /// `sphere` or `triangle`.
    pub primitive: String,
    /// What is tested with what, in a sentence.
    pub workload: String,
    /// The points.
    pub points: Vec<Point>,
}

/// One precision on one device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// The precision's id.
    #[serde(rename = "method")]
    pub precision: String,
    /// The device's place in [`Report::devices`].
    pub device: usize,
    /// Its errors.
    pub errors: Errors,
    /// Nanoseconds a test of one ray with one primitive, by the device's own clock; on the CPU engine by the wall clock.
    /// None where a device has no clock.
    pub kernel_ns: Option<Timing>,
    /// Nanoseconds a test, from the first ray handed over to the last hit back.
    pub ns: Timing,
    /// That over the same of `fast` on the same device, round by round.
    pub of_fast: Timing,
    /// Millions of rays a second against a tree of such primitives, end to end.
    pub mrays: Timing,
}

/// Error against distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DistanceCurve {
    /// The precision's id.
    #[serde(rename = "method")]
    pub precision: String,
    /// The device's place.
    pub device: usize,
    /// By distance.
    pub points: Vec<DistancePoint>,
}

/// One distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DistancePoint {
    /// Distance of the eye from the centre over the radius.
    pub distance: f64,
    /// The error of `t` in ULP.
    pub t: Quantiles,
    /// Misclassified, of all rays.
    pub wrong: Rate,
}

/// Wrong verdicts against the margin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MarginCurve {
    /// `sphere` (from the silhouette) or `triangle` (from an edge).
    pub primitive: String,
    /// The precision's id.
    #[serde(rename = "method")]
    pub precision: String,
    /// The device's place.
    pub device: usize,
    /// By margin.
    pub points: Vec<MarginPoint>,
    /// The largest margin at which a verdict was wrong; 0 where none was.
    pub largest_wrong: f64,
}

/// One bin of margins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MarginPoint {
    /// The middle of the bin: the exact distance of the line from the silhouette or the edge, over the largest
    /// coordinate of the
    /// problem, in units of 2^-24.
    pub margin: f64,
    /// Wrong verdicts.
    pub wrong: Rate,
}

/// One family of hard cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Family {
    /// 1 to 42.
    pub number: u32,
    /// Its name.
    pub name: String,
    /// What it stresses.
    pub stresses: String,
    /// Rays, and those that hit.
    pub rays: u64,
    /// Rays that hit something.
    pub hits: u64,
    /// The stages of the cascade, on the CPU engine.
    pub decided: Decided,
    /// Each precision on each device.
    pub rows: Vec<FamilyRow>,
}

/// A precision on a family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FamilyRow {
    /// The precision's id.
    #[serde(rename = "method")]
    pub precision: String,
    /// The device's place.
    pub device: usize,
    /// Its errors.
    pub errors: Errors,
    /// On another device than the first: whether every bit is that of the first.
    pub same_bits: Option<bool>,
}

/// Leaks of a closed mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leaks {
    /// The mesh, and how many triangles it has.
    pub mesh: String,
    /// Its triangles.
    pub triangles: u64,
    /// `vertices` or `edges`.
    pub target: String,
    /// A precision on a device, or a peer.
    pub who: String,
    /// Rays from inside that hit nothing.
    pub leaked: Rate,
    /// Rays that crossed an even number of times: inside taken for outside. None where it does not count.
    pub even: Option<Rate>,
    /// Rays that cross more often than exact arithmetic says: a shared edge or vertex counted twice. None where it does
    /// not count.
    pub double: Option<Rate>,
}

/// A change that must not change an answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Invariant {
    /// Such as `vertex order`, `axis order`, `scale by 2^k`.
    pub change: String,
    /// `sphere` or `triangle`.
    pub primitive: String,
    /// The precision's id.
    #[serde(rename = "method")]
    pub precision: String,
    /// The device's place.
    pub device: usize,
    /// Rays whose hit or miss changed.
    pub verdict: Rate,
    /// Rays whose `t` changed in any bit, of those that hit before and after.
    pub t: Rate,
}

/// A scene as users have them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRow {
    /// The scene, such as `ball, 70 k triangles`.
    pub scene: String,
    /// `primary`, `incoherent` or `diffuse`.
    pub rays: String,
    /// Every contestant.
    pub rows: Vec<SceneEntry>,
}

/// A contestant on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEntry {
    /// A precision on a device, or a peer with its version.
    pub who: String,
    /// Whether it is a peer.
    pub peer: bool,
    /// Seconds to build its tree.
    pub build: Timing,
    /// Millions of rays a second, end to end.
    pub mrays: Timing,
    /// Millions of rays a second by the device's own clock.
    pub kernel_mrays: Option<Timing>,
    /// The rate over that of `fast` on the same device, round by round; none for peers.
    pub of_fast: Option<Timing>,
    /// The errors of a sample of the same rays.
    pub errors: Errors,
}

/// Another intersector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Peer {
    /// Its name.
    pub name: String,
    /// Its version; empty where it was not measured.
    pub version: String,
    /// How it was called; or why it was not measured.
    pub note: String,
    /// Whether it was measured: its rows are in `scenes` and `leaks`.
    pub measured: bool,
}

/// The two oracles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Oracles {
    /// Rays that both answered: verdict, primitive and every bit of t, u, v.
    pub compared: u64,
    /// Rays on which they differ.
    pub disagreed: u64,
    /// Rays whose numbers are too far apart for the second one.
    pub beyond: u64,
}
