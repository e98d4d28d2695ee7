use std::path::Path;

use crate::Error;

/// How a table of rays or hits is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// NumPy's format, little-endian.
    Npy,
    /// Comma-separated values with a header line.
    Csv,
    /// Apache Parquet; needs the feature `parquet`.
    Parquet,
}

impl Format {
    /// The format that the ending of `path` names, in any case of letters.
    ///
    /// # Errors
    /// [`Error::Bad`] where the ending is none of `.npy`, `.csv` and `.parquet`.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("npy") => Ok(Self::Npy),
            Some("csv") => Ok(Self::Csv),
            Some("parquet") => Ok(Self::Parquet),
            Some(other) => Err(unknown(path, format!("the ending .{other} is not known"))),
            None => Err(unknown(path, "it has no ending".to_owned())),
        }
    }

    /// The format that starts with these bytes: by its magic number, else CSV.
    pub(super) fn sniff(head: &[u8]) -> Self {
        match head {
            [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => Self::Npy,
            [b'P', b'A', b'R', b'1', ..] => Self::Parquet,
            _ => Self::Csv,
        }
    }
}

fn unknown(path: &Path, what: String) -> Error {
    Error::bad(path.display().to_string(), "name", what, "give a name that ends in .npy, .csv or .parquet")
}

/// Whether the path means stdin or stdout.
pub(super) fn is_standard_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What a build without the feature says to a Parquet file.
#[cfg(not(feature = "parquet"))]
pub(super) fn no_parquet(path: &Path) -> Error {
    Error::bad(
        path.display().to_string(),
        "format",
        "this build of Rayproof does not know Parquet",
        "build it with `--features parquet`, or give .npy or .csv",
    )
}
