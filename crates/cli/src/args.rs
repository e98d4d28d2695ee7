//! What can be typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use rayproof::files::Origin;
use rayproof::stream::Shard;
use rayproof::{DeviceChoice, Precision};

use crate::choices::{Format, Invalid, Kind, OnRounding, Query, Show, precision};
use crate::parse::{self, Size, input};

/// Shoots rays at spheres and triangles, on the GPU or the CPU, and can prove each answer against exact arithmetic.
#[derive(Debug, Parser)]
#[command(name = "rayproof", version, max_term_width = 100, subcommand_required = true, arg_required_else_help = true)]
#[command(after_help = "\
A first run:
  rayproof render bunny.ply -o bunny.png
  rayproof rays bunny.ply -o rays.npy
  rayproof intersect bunny.ply rays.npy -o hits.npy --check 1000

Exit codes: 0 done, 1 failed while running, 2 usage, 3 --check found a disagreement, 4 no such device, 5 bad input.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Answer a file of rays: where does each first meet the scene?
    Intersect(Intersect),
    /// Write a file of rays that suits a scene.
    Rays(Rays),
    /// Draw a scene, or the error of every pixel.
    Render(Render),
    /// Say what a scene holds: is it closed, what was left out of it, what did rounding change?
    Info(Info),
    /// List the devices and measure the arithmetic of each.
    Devices(Devices),
    /// Measure speed against error, and write a page of it.
    Report(Report),
}

const SCENE: &str = "\
The scene: a mesh (.obj .ply .stl .gltf .glb, also with .gz), or a scene file (.toml) that lists meshes and spheres:

  [[geometry]]
  mesh = \"bunny.ply\"                # relative to the scene file
  [[geometry]]
  spheres = [[0.0, 1.0, 0.0, 0.5]]  # x, y, z, radius
  [[geometry]]
  spheres = \"beads.npy\"             # (N, 4) float32, or .csv with x,y,z,r
  [camera]                          # optional
  eye = [0, 1, 5]
  target = [0, 1, 0]
  up = [0, 1, 0]
  fov_y = 40                        # degrees

A line `origin = [x, y, z]` before them is subtracted from every point, the camera's and the rays' too.";

const DEVICE: &str = "\
What computes: 'auto' is a hardware GPU if there is one, else the CPU engine; 'cpu' is the CPU engine; 'gpu' is the \
best adapter, a software one too; 'index:N', 'name:TEXT' and 'pci:BUS' pick one adapter";

const PRECISION: &str = "\
How: 'exact' is the answer of exact arithmetic, its numbers rounded once; 'fast' is f32 in its best-conditioned form. \
Without a promise, for comparison: 'textbook', the schoolbook quadratic in f32; 'classic', the stable quadratic and \
Cramer's rule in f32; 'pair' and 'double', the formulas of fast in pairs of f32 and in f64";

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof intersect bunny.ply rays.npy -o hits.npy
  rayproof intersect scene.toml rays.csv -o hits.csv --query any --device cpu
  rayproof rays bunny.ply -o - | rayproof intersect bunny.ply - -o hits.npy --check 1000 --json

HITS has one row a ray, in the rays' order, and appears only when it is whole.
  closest: t, u, v (float32), geometry, primitive (uint32); a miss is t = inf, u = v = 0, both ids 4294967295
  any:     hit (uint8)
  count:   count (uint32)")]
pub(crate) struct Intersect {
    #[arg(value_name = "SCENE", value_parser = input(), help = "The scene: .obj .ply .stl .gltf .glb .toml", long_help = SCENE)]
    pub(crate) scene: PathBuf,

    /// The rays, '-' for stdin: .npy of shape (N, 6) or (N, 8), .csv or .parquet with ox,oy,oz,dx,dy,dz and, if wanted, t_min,t_max
    #[arg(value_name = "RAYS", value_parser = input())]
    pub(crate) rays: PathBuf,

    /// Where the hits go, '-' for stdout: .npy, .csv or .parquet
    #[arg(short, long, value_name = "HITS")]
    pub(crate) output: PathBuf,

    /// What is asked of each ray
    #[arg(long, value_enum, default_value_t)]
    pub(crate) query: Query,

    #[arg(long, default_value = Precision::Exact.name(), value_parser = precision(), help = PRECISION)]
    pub(crate) precision: Precision,

    #[arg(long, default_value_t, help = DEVICE)]
    pub(crate) device: DeviceChoice,

    /// Answer N rays, spread evenly, again in exact arithmetic; print disagreements and exit with 3 if there are any
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) check: u64,

    /// What a bad ray (not finite, zero direction, t_min > t_max) is: an error, or a miss that is counted
    #[arg(long, value_enum, default_value_t)]
    pub(crate) invalid: Invalid,

    #[command(flatten)]
    pub(crate) place: Place,

    /// Pass these columns of the rays (.csv, .parquet) on to HITS (.csv, .parquet), after its own: an id, a weight
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    pub(crate) keep: Vec<String>,

    /// Answer only the I-th (from 0) of N contiguous shares of the rays; the shares' hits, joined, are the whole. A bad ray is
    /// the fault of the share that holds it
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,

    /// Print the summary as one JSON object on stdout
    #[arg(long)]
    pub(crate) json: bool,

    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,

    /// The format of HITS where it is '-'
    #[arg(long, value_enum, default_value_t)]
    pub(crate) to: Format,
}

/// Where the scene is, and what becomes of digits that `f32` has no room for there.
#[derive(Debug, Default, Args)]
pub(crate) struct Place {
    /// Subtract X,Y,Z from scene and rays, exactly, before they are rounded to f32; 'auto' is the middle of the scene's box, on
    /// a grid of powers of two [default: `origin` in the scene file]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::origin, allow_hyphen_values = true)]
    pub(crate) origin: Option<Origin>,

    /// What is said where rounding to f32 moves a vertex, a sphere or a ray's origin by more than a millionth of the scene's size
    #[arg(long, value_enum, default_value_t)]
    pub(crate) rounding: OnRounding,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof rays bunny.ply -o primary.npy --size 1920x1080
  rayproof rays bunny.ply -o incoherent.npy --kind incoherent --count 1000000 --seed 7
  rayproof rays bunny.ply -o - --kind diffuse --count 100000 | rayproof intersect bunny.ply - -o hits.npy

The same command writes the same bytes on every run.")]
pub(crate) struct Rays {
    #[arg(value_name = "SCENE", value_parser = input(), help = "The scene: .obj .ply .stl .gltf .glb .toml", long_help = SCENE)]
    pub(crate) scene: PathBuf,

    /// Where the rays go, '-' for stdout: .npy (N, 6), .csv or .parquet
    #[arg(short, long, value_name = "RAYS")]
    pub(crate) output: PathBuf,

    #[arg(long, value_enum, default_value_t, help = "Which rays")]
    pub(crate) kind: Kind,

    /// The size of the picture that primary and diffuse rays are made for [default: 1024x1024]
    #[arg(long, value_name = "WxH", value_parser = parse::size, conflicts_with = "count")]
    pub(crate) size: Option<Size>,

    /// How many incoherent or diffuse rays [default: 1048576 incoherent; one diffuse for every pixel that hits]
    #[arg(long, value_name = "N")]
    pub(crate) count: Option<u64>,

    /// What the random numbers start from
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub(crate) seed: u64,

    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,

    /// The format of RAYS where it is '-'
    #[arg(long, value_enum, default_value_t)]
    pub(crate) to: Format,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof render bunny.ply -o bunny.png
  rayproof render scene.toml -o depth.png --show depth --size 1920x1080 --device cpu
  rayproof render bunny.ply -o error.png --show error --precision classic --size 200x150

The picture is seen from the scene file's camera, else from one that frames the scene.")]
pub(crate) struct Render {
    #[arg(value_name = "SCENE", value_parser = input(), help = "The scene: .obj .ply .stl .gltf .glb .toml", long_help = SCENE)]
    pub(crate) scene: PathBuf,

    /// Where the picture goes (.png), '-' for stdout
    #[arg(short, long, value_name = "PICTURE")]
    pub(crate) output: PathBuf,

    /// The size of the picture, in pixels
    #[arg(long, value_name = "WxH", value_parser = parse::size, default_value = "800x600")]
    pub(crate) size: Size,

    #[arg(long, value_enum, default_value_t, help = "What a pixel shows")]
    pub(crate) show: Show,

    #[arg(long, default_value = Precision::Exact.name(), value_parser = precision(), help = PRECISION)]
    pub(crate) precision: Precision,

    #[arg(long, default_value_t, help = DEVICE)]
    pub(crate) device: DeviceChoice,

    #[command(flatten)]
    pub(crate) place: Place,

    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof info bunny.ply
  rayproof info scene.toml --origin auto --json

A surface is closed where every edge is of an even number of triangles; vertices are one where they are at one place. Edges and \
triangles are named by the first triangle, from 0 within its geometry.")]
pub(crate) struct Info {
    #[arg(value_name = "SCENE", value_parser = input(), help = "The scene: .obj .ply .stl .gltf .glb .toml", long_help = SCENE)]
    pub(crate) scene: PathBuf,

    #[command(flatten)]
    pub(crate) place: Place,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof devices
  rayproof devices --json

Each adapter runs a small kernel whose results are compared, bit for bit, with what IEEE 754 arithmetic gives: 'IEEE' \
means that the precision 'fast' has the same bits there as on the CPU. 'exact' has them on every device; the last line tells \
which numbers it computes with there.")]
pub(crate) struct Devices {
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  rayproof report --quick
  rayproof report -o report-gpu --device gpu --scene bunny.ply
  rayproof report --device gpu --peers
  rayproof report -o both --from report/report.json report-gpu/report.json

DIR gets report.html (one file, with its plots), report.md, plot.svg and report.json (every number); \
those of an earlier run are replaced. The CPU engine is always measured: it \
is what others are compared with. A quick report takes about a minute on two cores, a full one some seven.")]
pub(crate) struct Report {
    /// The folder that gets the report; it is made where it is not there
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    pub(crate) output: PathBuf,

    /// What is measured beside the CPU engine: as for `intersect`; may be given several times
    #[arg(long, value_name = "DEVICE")]
    pub(crate) device: Vec<DeviceChoice>,

    /// Fewer rays and runs
    #[arg(long)]
    pub(crate) quick: bool,

    /// A scene to measure beside the made ones; may be given several times
    #[arg(long, value_name = "SCENE", value_parser = input())]
    pub(crate) scene: Vec<PathBuf>,

    /// Measure other intersectors too: Embree, from PyPI, in a virtual environment in VENV (about a gigabyte), and, in a
    /// build with the
    /// cargo feature peers, obvhs, parry3d and bvh [default VENV: rayproof/peers in the user's cache]
    #[arg(long, value_name = "VENV", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    pub(crate) peers: Option<PathBuf>,

    /// Measure nothing: make the pages of these report.json files, their devices side by side
    #[arg(long, value_name = "JSON", num_args = 1.., conflicts_with_all = ["device", "quick", "scene", "peers"])]
    pub(crate) from: Vec<PathBuf>,

    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_consistent() {
        super::Cli::command().debug_assert();
    }
}
