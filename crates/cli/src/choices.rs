//! The words to choose from on the command line.

use std::path::Path;

use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rayproof::Precision;
use rayproof::files;
use rayproof::scene::InvalidRays;

use crate::exit::{Code, Failure};
use crate::target;

/// What is asked of a ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Query {
    /// Where it first meets the scene
    #[default]
    Closest,
    /// Whether it meets the scene at all
    Any,
    /// How often it crosses the surface (precision exact only)
    Count,
}

/// Reads a precision, each with what it is.
pub(crate) fn precision() -> impl TypedValueParser<Value = Precision> {
    let values = Precision::ALL.map(|precision| {
        PossibleValue::new(precision.name()).help(match precision {
            Precision::Textbook => "The schoolbook quadratic in f32, to see it fail; triangles as classic",
            Precision::Classic => "The stable quadratic and Cramer's rule in f32",
            Precision::Fast => "f32 in its best-conditioned form",
            Precision::Pair => "The formulas of fast in pairs of f32",
            Precision::Double => "The formulas of fast in f64",
            Precision::Exact => "The answer of exact arithmetic, its numbers rounded once",
        })
    });
    PossibleValuesParser::new(values).try_map(|name| name.parse::<Precision>())
}

/// What becomes of a bad ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Invalid {
    /// The run stops, with exit code 5
    #[default]
    Error,
    /// It hits nothing, and is counted
    Miss,
}

impl From<Invalid> for InvalidRays {
    fn from(invalid: Invalid) -> Self {
        match invalid {
            Invalid::Error => Self::Error,
            Invalid::Miss => Self::Miss,
        }
    }
}

/// What becomes of numbers that rounding to `f32` moves by more than a millionth of the scene's size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum OnRounding {
    /// A note
    #[default]
    Warn,
    /// The run stops, with exit code 5
    Error,
    /// Nothing
    Allow,
}

/// The formats of rays and hits on stdout; on stdin the first bytes tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    #[default]
    Npy,
    Csv,
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Format {
    /// The format to write `path` in: this one for stdout, else what its ending says.
    ///
    /// # Errors
    /// A usage error where the ending says nothing; another where the folder is not there.
    pub(crate) fn of_output(self, path: &Path) -> Result<files::Format, Failure> {
        if path.as_os_str() != "-" {
            let format = files::Format::of(path).map_err(|e| Failure::new(Code::Usage, unknown(path, &e)))?;
            return target::has_folder(path).map(|()| format);
        }
        Ok(match self {
            Self::Npy => files::Format::Npy,
            Self::Csv => files::Format::Csv,
            #[cfg(feature = "parquet")]
            Self::Parquet => files::Format::Parquet,
        })
    }
}

/// The endings that this build writes.
const ENDINGS: &str = if cfg!(feature = "parquet") { ".npy, .csv or .parquet" } else { ".npy or .csv" };

fn unknown(path: &Path, error: &files::Error) -> String {
    match error {
        files::Error::Bad(bad) => {
            format!("--output: {}: {}; give a name that ends in {ENDINGS}", path.display(), bad.what)
        }
        other => format!("--output: {other}"),
    }
}

/// Rays made for a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// Through the pixels of a picture, row by row from the top left
    #[default]
    Primary,
    /// From random points of the scene's bounding sphere to random points of its box
    Incoherent,
    /// From where primary rays hit, in cosine-weighted random directions about the surface's normal
    Diffuse,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// The geometric normal, lit from the camera
    #[default]
    Normal,
    /// The distance: yellow is near, dark blue is far
    Depth,
    /// Which primitive: one colour each, the same in every picture
    Primitive,
    /// The barycentric weights: red, green and blue for the first, second and third vertex
    Uv,
    /// The error of t in ULP, against exact arithmetic (slow): from dark violet (none) over green to yellow (a
    /// million and more), red where another primitive or none is right
    Error,
    /// Which stage of the cascade decides the hit (precision exact only): blue in f32, orange in double width, red exactly
    #[value(name = "tier", alias = "stage")]
    Stage,
}
