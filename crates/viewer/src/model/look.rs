//! What a pixel shows, and by whose answers.

use rayproof::Precision;
use serde::{Deserialize, Serialize};

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Mode {
    /// The geometric normal, lit from the camera.
    #[default]
    Normal,
    /// The distance.
    Depth,
    /// Which primitive.
    Primitive,
    /// The barycentric weights.
    Uv,
    /// Hit or miss.
    Mask,
    /// The error of t against exact arithmetic.
    Error,
    /// Whether the answer is right.
    Verdict,
    /// Which stage of the cascade decides.
    Stage,
    /// How two answers differ.
    Difference,
}

impl Mode {
    pub(crate) const ALL: [Self; 9] = [
        Self::Normal,
        Self::Depth,
        Self::Primitive,
        Self::Uv,
        Self::Mask,
        Self::Error,
        Self::Verdict,
        Self::Stage,
        Self::Difference,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::Primitive => "primitive",
            Self::Uv => "uv",
            Self::Mask => "mask",
            Self::Error => "error",
            Self::Verdict => "verdict",
            Self::Stage => "stage",
            Self::Difference => "difference",
        }
    }

    /// One sentence for the user.
    pub(crate) const fn explains(self) -> &'static str {
        match self {
            Self::Normal => "The surface's geometric normal as red, green and blue, lit from the camera.",
            Self::Depth => "The distance t: yellow is near, dark blue is far.",
            Self::Primitive => "Which primitive was hit: one colour each, the same in every picture.",
            Self::Uv => "The barycentric weights: red, green and blue for the first, second and third vertex.",
            Self::Mask => "Hit or miss.",
            Self::Error => "How far t is from the exact answer, in units in the last place (ULP).",
            Self::Verdict => "Whether the answer is the exact one: hits that are not there, hits that were missed.",
            Self::Stage => "Which stage of the precision exact decides each pixel.",
            Self::Difference => {
                "How far apart the t of two precisions are, in ULP; red where they hit different things."
            }
        }
    }

    /// Whether the exact answer is needed.
    pub(crate) const fn judges(self) -> bool {
        matches!(self, Self::Error | Self::Verdict)
    }

    /// Whether the picture can be split between two precisions.
    pub(crate) const fn splits(self) -> bool {
        !matches!(self, Self::Stage | Self::Difference)
    }
}

impl std::str::FromStr for Mode {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|mode| mode.name() == text).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("there is no mode \"{text}\"; give one of {names}")
        })
    }
}

/// Where an answer is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Place {
    /// On the device that was opened; where that is the CPU engine, there.
    #[default]
    Device,
    /// On the CPU engine.
    Cpu,
}

/// Whose answer it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Source {
    /// By which precision.
    #[serde(with = "by_name")]
    pub precision: Precision,
    /// And where.
    pub place: Place,
}

/// A precision is kept by its name.
mod by_name {
    use rayproof::Precision;
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::Serializer;

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
    pub(super) fn serialize<S: Serializer>(precision: &Precision, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(precision.name())
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Precision, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

impl Source {
    pub(crate) const EXACT: Self = Self::device(Precision::Exact);

    /// A precision on the device.
    #[must_use]
    pub const fn device(precision: Precision) -> Self {
        Self { precision, place: Place::Device }
    }

    pub(crate) const fn cpu(precision: Precision) -> Self {
        Self { precision, place: Place::Cpu }
    }
}

/// How a view is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Look {
    /// What a pixel shows.
    pub mode: Mode,
    /// The precision whose answers are shown.
    pub left: Source,
    /// Another one: right of the split, or the second of a difference.
    pub right: Source,
    /// Whether the picture is split between the two.
    pub split: bool,
}

impl Default for Look {
    fn default() -> Self {
        let (left, right) = (Source::EXACT, Source::device(Precision::Fast));
        Self { mode: Mode::default(), left, right, split: false }
    }
}

impl Look {
    /// Whether the right-hand side of the split is shown.
    pub(crate) const fn is_split(&self) -> bool {
        self.split && self.mode.splits()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_have_their_own_names() {
        for mode in Mode::ALL {
            assert_eq!(mode.name().parse(), Ok(mode));
        }
        assert!("normals".parse::<Mode>().is_err_and(|e| e.contains("verdict")));
    }
}
