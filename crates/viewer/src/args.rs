//! What can be typed.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use rayproof::{DeviceChoice, Precision};

use crate::{Look, Mode, Panel, Script, Source};

/// Shows a scene by the kernels themselves: its hits, their errors, and the calculation behind each pixel.
#[derive(Debug, Parser)]
#[command(name = "rayproof-viewer", version, max_term_width = 100)]
#[command(after_help = "\
Examples:
  rayproof-viewer bunny.ply
  rayproof-viewer scene.toml --mode error --precision fast
  rayproof-viewer --mode error --precision textbook --distance 4 --screenshot error.png

F1 in the window lists the keys. Exit codes: 0 done, 1 failed while running or no window could be opened, \
2 usage, 4 no such device, 5 the scene cannot be read (where the window closes by itself; else it says so).")]
pub(crate) struct Cli {
    /// The scene: .obj .ply .stl .gltf .glb .toml; else the last one that was open
    #[arg(value_name = "SCENE", conflicts_with = "family")]
    pub(crate) scene: Option<PathBuf>,

    /// What traces: 'auto' is a hardware GPU if there is one, else the CPU engine; 'cpu'; 'gpu' is the best adapter, a software
    /// one too; 'index:N', 'name:TEXT' and 'pci:BUS' pick one adapter
    #[arg(long, default_value_t)]
    pub(crate) device: DeviceChoice,

    /// What paints the window: 'auto' is the GPU that traces; without one OpenGL, else Vulkan
    #[arg(long, value_enum, default_value_t)]
    pub(crate) painter: Painter,

    /// What pixels show: normal, depth, primitive, uv, mask, error, verdict, stage or difference
    #[arg(long)]
    pub(crate) mode: Option<Mode>,

    /// Whose answers: textbook, classic, fast, pair, double or exact
    #[arg(long, alias = "method")]
    pub(crate) precision: Option<Precision>,

    /// Another precision, right of a split or to differ from
    #[arg(long, value_name = "PRECISION")]
    pub(crate) against: Option<Precision>,

    /// The size of the picture in pixels; else that of its place in the window
    #[arg(long, value_name = "WxH", value_parser = pair)]
    pub(crate) size: Option<[u32; 2]>,

    /// The size of the window
    #[arg(long, value_name = "WxH", value_parser = pair)]
    pub(crate) window: Option<[u32; 2]>,

    /// Hang a scene of a family of hard cases, 1 to 42: the family's number, and the scene's
    #[arg(long, value_name = "N[/SCENE]", value_parser = family)]
    pub(crate) family: Option<[usize; 2]>,

    /// Walk away by so many powers of ten of the scene's size, zoomed so that it looks the same
    #[arg(long, value_name = "DECADES", value_parser = decades, allow_hyphen_values = true)]
    pub(crate) distance: Option<f64>,

    /// Inspect a pixel of the picture, counted from its upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pub(crate) inspect: Option<[u32; 2]>,

    /// Which panel is open: none, inspector, gallery, plot or help
    #[arg(long, value_parser = panel)]
    pub(crate) panel: Option<Option<Panel>>,

    /// When all of this is shown, write a picture of the window (.png) and close it
    #[arg(long, value_name = "PNG", value_parser = png)]
    pub(crate) screenshot: Option<PathBuf>,

    /// Orbit for so many seconds, print how fast pictures and frames came as JSON, and close the window
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub(crate) measure: Option<f64>,
}

/// What paints the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Painter {
    #[default]
    Auto,
    Vulkan,
    Opengl,
}

impl Cli {
    /// Whether nobody looks at the window: it closes by itself.
    pub(crate) const fn is_unattended(&self) -> bool {
        self.screenshot.is_some() || self.measure.is_some()
    }

    /// How the scene is shown, where anything is said about it.
    pub(crate) fn look(&self) -> Option<Look> {
        if self.mode.is_none() && self.precision.is_none() && self.against.is_none() && !self.is_unattended() {
            return None;
        }
        let mut look = Look { mode: self.mode.unwrap_or_default(), ..Look::default() };
        look.left = self.precision.map_or(look.left, Source::device);
        look.right = self.against.map_or(look.right, Source::device);
        look.split = self.against.is_some();
        Some(look)
    }

    /// What is done without a user; none where the window is for one.
    pub(crate) fn script(&self) -> Option<Script> {
        let steers = self.family.is_some() || self.distance.is_some() || self.inspect.is_some();
        (self.is_unattended() || steers).then(|| {
            let mut script = Script::default();
            (script.family, script.distance, script.inspect) = (self.family, self.distance, self.inspect);
            script.measure = self.measure;
            script.screenshot.clone_from(&self.screenshot);
            script
        })
    }
}

fn panel(text: &str) -> Result<Option<Panel>, String> {
    let panels = [
        ("none", None),
        ("inspector", Some(Panel::Inspector)),
        ("gallery", Some(Panel::Gallery)),
        ("plot", Some(Panel::Plot)),
        ("help", Some(Panel::Help)),
    ];
    let found = panels.into_iter().find(|(name, _)| *name == text);
    found.map(|(_, panel)| panel).ok_or_else(|| "give none, inspector, gallery, plot or help".to_owned())
}

fn pair(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse::<u32>().ok().filter(|side| (1..=16_384).contains(side));
    let sides = text.split_once('x').and_then(|(w, h)| Some([side(w)?, side(h)?]));
    sides.ok_or_else(|| "give WxH, both from 1 to 16384, for example 800x600".to_owned())
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let both = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    both.ok_or_else(|| "give X,Y, for example 400,300".to_owned())
}

fn family(text: &str) -> Result<[usize; 2], String> {
    let (number, scene) = text.split_once('/').unwrap_or((text, "1"));
    let both = number.parse().ok().zip(scene.parse().ok());
    let both = both.filter(|&(number, scene): &(usize, usize)| (1..=42).contains(&number) && scene > 0);
    both.map(<[usize; 2]>::from).ok_or_else(|| "give N or N/SCENE, with N from 1 to 42, for example 7/2".to_owned())
}

fn png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("a picture is a PNG; give a name that ends in .png".to_owned()) }
}

fn decades(text: &str) -> Result<f64, String> {
    let known = text.parse::<f64>().ok().filter(|x| (0.0..=8.0).contains(x));
    known.ok_or_else(|| "give a number from 0 to 8".to_owned())
}

fn seconds(text: &str) -> Result<f64, String> {
    let known = text.parse::<f64>().ok().filter(|x| (0.1..=3600.0).contains(x));
    known.ok_or_else(|| "give seconds, from 0.1 to 3600".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn words_are_strict() {
        assert_eq!([pair("800x600"), pixel("3, 4")], [Ok([800, 600]), Ok([3, 4])]);
        assert_eq!([family("7"), family("42/3")], [Ok([7, 1]), Ok([42, 3])]);
        for bad in ["", "800", "0x600", "800x", "99999x1"] {
            assert!(pair(bad).is_err(), "{bad}");
        }
        for bad in ["0", "43", "7/0", "x"] {
            assert!(family(bad).is_err(), "{bad}");
        }
        assert!(decades("9").is_err() && decades("nan").is_err() && seconds("-1").is_err() && pixel("3").is_err());
        assert!(png("x.PNG").is_ok() && png("x.txt").is_err() && png("png").is_err());
        assert!(panel("plots").is_err());
    }
}
