use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

use super::csv_rays::CsvRays;
use super::faults::Faults;
use super::format::{Format, is_standard_stream};
use super::npy_rays::NpyRays;
use crate::Error;
use rayproof_scene::{InvalidRays, Ray};

/// Where bytes come from.
pub(super) type Input = Box<dyn Read + Send>;

/// A table of rays in one format.
pub(super) trait Source: Send {
    /// Appends the next rays until there are `max` or the table ends. Rays before an error are appended.
    fn fill(&mut self, rays: &mut Vec<Ray>, max: usize, faults: &mut Faults) -> Result<(), Error>;

    /// The rows of the whole table, where its header tells.
    fn total(&self) -> Option<u64>;

    /// How many values changed so far because they were rounded to `f32`.
    fn rounded_values(&self) -> u64;
}

/// Reads rays from a file or stdin, a batch at a time.
///
/// The rows are `ox, oy, oz, dx, dy, dz` and, optionally, `t_min, t_max`, which are 0 and infinity where not given:
/// `.npy` of shape `(N, 6)` or `(N, 8)`, or columns of those names in `.csv` and `.parquet`.
pub struct RayReader {
    source: Box<dyn Source>,
    faults: Faults,
}

impl RayReader {
    /// Opens a file, or stdin for `-`, and reads its header.
    ///
    /// Without a `format` a file's ending tells it, and the first bytes of stdin.
    ///
    /// # Errors
    /// [`Error::Open`] where it cannot be opened, [`Error::Bad`] where the header is not that of a table of rays or
    /// the file's size is not what the header says, [`Error::Io`] where reading fails.
    pub fn open(path: &Path, format: Option<Format>, invalid: InvalidRays) -> Result<Self, Error> {
        if is_standard_stream(path) {
            return Self::from_input(path, Box::new(io::stdin()), format, invalid);
        }
        let format = format.map_or_else(|| Format::of(path), Ok)?;
        let open = |source| Error::Open { path: path.to_owned(), source };
        let file = File::open(path).map_err(open)?;
        let metadata = file.metadata().map_err(open)?;
        if metadata.is_dir() {
            return Err(open(io::ErrorKind::IsADirectory.into()));
        }
        let size = metadata.is_file().then_some(metadata.len());
        let source: Box<dyn Source> = match format {
            Format::Npy => Box::new(NpyRays::open(path, Box::new(file), size)?),
            Format::Csv => Box::new(CsvRays::open(path, Box::new(file))?),
            Format::Parquet if size.is_some() => parquet(path, file)?,
            Format::Parquet => return Self::from_input(path, Box::new(file), Some(format), invalid),
        };
        Ok(Self { source, faults: Faults::new(path.to_owned(), invalid) })
    }

    /// Reads from a pipe of unknown length; errors call it `path`.
    pub(super) fn from_input(
        path: &Path,
        mut input: Input,
        format: Option<Format>,
        invalid: InvalidRays,
    ) -> Result<Self, Error> {
        let io_error = |source| Error::Io { path: path.to_owned(), source };
        let mut head = Vec::new();
        (&mut input).take(6).read_to_end(&mut head).map_err(io_error)?;
        let format = format.unwrap_or_else(|| Format::sniff(&head));
        let mut input: Input = Box::new(Cursor::new(head).chain(input));
        let source: Box<dyn Source> = match format {
            Format::Npy => Box::new(NpyRays::open(path, input, None)?),
            Format::Csv => Box::new(CsvRays::open(path, input)?),
            // A Parquet file is read from its end: a pipe has to be stored first.
            Format::Parquet => {
                let mut file = tempfile::tempfile().map_err(io_error)?;
                io::copy(&mut input, &mut file).map_err(io_error)?;
                parquet(path, file)?
            }
        };
        Ok(Self { source, faults: Faults::new(path.to_owned(), invalid) })
    }

    /// Replaces what is in `rays` by the next rays, `max` at most; returns how many, 0 at the end.
    ///
    /// # Errors
    /// [`Error::Bad`] at a bad ray (with [`InvalidRays::Error`]; the rest is read to count the others), a malformed
    /// row, or where the input ends too soon or too late; [`Error::Io`] where reading fails. After an error the
    /// reader is spent.
    pub fn next_batch(&mut self, rays: &mut Vec<Ray>, max: usize) -> Result<usize, Error> {
        rays.clear();
        let filled = self.source.fill(rays, max, &mut self.faults);
        // A bad ray comes before whatever ended the batch, so it is the first thing wrong.
        if self.faults.stops() {
            let mut more = filled.is_ok() && !rays.is_empty();
            while more {
                rays.clear();
                more = self.source.fill(rays, super::BLOCK_ROWS, &mut self.faults).is_ok() && !rays.is_empty();
            }
            rays.clear();
            return self.faults.error().map_or(Ok(0), Err);
        }
        filled?;
        Ok(rays.len())
    }

    /// How many rays there are in all, where the header tells: not for CSV.
    #[must_use]
    pub fn total(&self) -> Option<u64> {
        self.source.total()
    }

    /// How many bad rays were handed on as misses so far.
    #[must_use]
    pub fn invalid(&self) -> u64 {
        self.faults.count()
    }

    /// How many `float64` values changed so far when they were rounded to the nearest `f32`.
    #[must_use]
    pub fn rounded_values(&self) -> u64 {
        self.source.rounded_values()
    }
}

#[cfg(feature = "parquet")]
fn parquet(path: &Path, file: File) -> Result<Box<dyn Source>, Error> {
    Ok(Box::new(super::parquet_rays::ParquetRays::open(path, file)?))
}

#[cfg(not(feature = "parquet"))]
fn parquet(path: &Path, _: File) -> Result<Box<dyn Source>, Error> {
    Err(super::format::no_parquet(path))
}
