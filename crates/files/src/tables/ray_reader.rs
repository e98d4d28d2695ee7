use std::fs::File;
use std::io::{self, Cursor, Read};
use std::ops::Range;
use std::path::Path;

use super::admission::Admission;
use super::csv_rays::CsvRays;
use super::format::{Format, is_standard_stream};
use super::input::Input;
use super::kept::{Kept, KeptColumns};
use super::npy_rays::NpyRays;
use crate::gzip::{unpacked_name, unpacking};
use crate::quote::quoted;
use crate::{Error, Rounding};
use rayproof_scene::{InvalidRays, Ray};

/// A table of rays in one format.
pub(super) trait Source: Send {
    /// Appends the next rays, and the values of the columns that are kept, until there are `max` or the table ends. Rays before
    /// an error are appended.
    fn fill(
        &mut self,
        rays: &mut Vec<Ray>,
        kept: &mut Kept,
        max: usize,
        admission: &mut Admission,
    ) -> Result<(), Error>;

    /// The names of all its columns.
    fn columns(&self) -> Vec<&str>;

    /// Keeps the columns of these numbers. Asked before the first `fill` and before `select`.
    fn keep(&mut self, columns: &[usize]) -> Result<KeptColumns, Error>;

    /// The rows of the whole table, where its header tells.
    fn total(&self) -> Option<u64>;

    /// The rows of the whole table, counted where its header does not tell; `None` where they pass but once.
    fn count(&mut self) -> Result<Option<u64>, Error> {
        Ok(self.total())
    }

    /// Goes to the first of these rows, without a look at those before, and ends after the last. Asked before the first `fill`.
    fn select(&mut self, rows: Range<u64>) -> Result<(), Error>;
}

/// Reads rays from a file or stdin, a batch at a time.
///
/// The rows are `ox, oy, oz, dx, dy, dz` and, optionally, `t_min, t_max`, which are 0 and infinity where not given:
/// `.npy` of shape `(N, 6)` or `(N, 8)`, or columns of those names in `.csv` and `.parquet`.
pub struct RayReader {
    source: Box<dyn Source>,
    admission: Admission,
    /// How many rows were selected, if any were.
    selected: Option<u64>,
    /// Of the last batch.
    kept: Kept,
}

impl RayReader {
    /// Opens a file, or stdin for `-`, and reads its header.
    ///
    /// Without a `format` a file's ending tells it, after which `.gz` may follow, and the first bytes of stdin.
    ///
    /// # Errors
    /// [`Error::Open`] where it cannot be opened, [`Error::Bad`] where the header is not that of a table of rays or
    /// the file's size is not what the header says, [`Error::Io`] where reading fails.
    pub fn open(path: &Path, format: Option<Format>, invalid: InvalidRays) -> Result<Self, Error> {
        if is_standard_stream(path) {
            return Self::from_pipe(path, Box::new(io::stdin()), format, invalid);
        }
        let unpacked = unpacked_name(path);
        let format = format.map_or_else(|| Format::of(unpacked.as_deref().unwrap_or(path)), Ok)?;
        let open = |source| Error::Open { path: path.to_owned(), source };
        let file = File::open(path).map_err(open)?;
        let metadata = file.metadata().map_err(open)?;
        if metadata.is_dir() {
            return Err(open(io::ErrorKind::IsADirectory.into()));
        }
        if unpacked.is_some() {
            return Self::from_pipe(path, unpacking(file), Some(format), invalid);
        }
        if !metadata.is_file() {
            return Self::from_pipe(path, Box::new(file), Some(format), invalid);
        }
        let source: Box<dyn Source> = match format {
            Format::Npy => Box::new(NpyRays::open(path, Input::File(file), Some(metadata.len()))?),
            Format::Csv => Box::new(CsvRays::open(path, Input::File(file))?),
            Format::Parquet => parquet(path, file)?,
        };
        Ok(Self::new(path, source, invalid))
    }

    fn new(path: &Path, source: Box<dyn Source>, invalid: InvalidRays) -> Self {
        Self { source, admission: Admission::new(path.to_owned(), invalid), selected: None, kept: Kept::default() }
    }

    /// Reads from a pipe of unknown length; errors call it `path`.
    pub(super) fn from_pipe(
        path: &Path,
        mut pipe: Box<dyn Read + Send>,
        format: Option<Format>,
        invalid: InvalidRays,
    ) -> Result<Self, Error> {
        let io_error = |source| Error::Io { path: path.to_owned(), source };
        let mut head = Vec::new();
        (&mut pipe).take(6).read_to_end(&mut head).map_err(io_error)?;
        let sniffed = Format::sniff(&head);
        let format = format.unwrap_or(sniffed);
        let mut input = Input::Pipe(Box::new(Cursor::new(head).chain(pipe)));
        let source: Box<dyn Source> = match format {
            Format::Npy => Box::new(NpyRays::open(path, input, None)?),
            Format::Csv => Box::new(CsvRays::open(path, input)?),
            // A Parquet file is read from its end: a pipe has to be stored first, if it is one.
            #[cfg(not(feature = "parquet"))]
            Format::Parquet => return Err(super::format::no_parquet(path)),
            #[cfg(feature = "parquet")]
            Format::Parquet if sniffed != format => {
                let what = "it does not start as a Parquet file does";
                return Err(Error::bad(path.display().to_string(), "header", what, "give a whole Parquet file"));
            }
            #[cfg(feature = "parquet")]
            Format::Parquet => {
                let mut file = tempfile::tempfile().map_err(io_error)?;
                io::copy(&mut input, &mut file).map_err(io_error)?;
                parquet(path, file)?
            }
        };
        Ok(Self::new(path, source, invalid))
    }

    /// How many rows there are in all: what the header says, else counted by going through a file once, without a look at the
    /// numbers, and back; `None` for a CSV pipe.
    ///
    /// # Errors
    /// [`Error::Io`] where reading fails, [`Error::Bad`] at a line without an end.
    pub fn count(&mut self) -> Result<Option<u64>, Error> {
        self.source.count()
    }

    /// Reads these rows only, numbered from 0 as in the file. Those before are not read where a file can be sought in (`.npy`, and
    /// Parquet by its row groups), and never looked at: a ray or a number that is bad is no fault of a table that does not hold it.
    ///
    /// To be called before the first batch.
    ///
    /// # Errors
    /// [`Error::Io`] where reading fails, [`Error::Bad`] where the input ends before the first of them.
    ///
    /// # Panics
    /// When there are known to be fewer rows.
    pub fn select(&mut self, rows: Range<u64>) -> Result<(), Error> {
        let total = self.total().unwrap_or(u64::MAX);
        assert!(rows.start <= rows.end && rows.end <= total, "rows {rows:?} of {total}");
        self.selected = Some(rows.end - rows.start);
        self.source.select(rows)
    }

    /// Replaces what is in `rays` by the next rays, `max` at most; returns how many, 0 at the end.
    ///
    /// # Errors
    /// [`Error::Bad`] at a bad ray (with [`InvalidRays::Error`]; the rest is read to count the others), a malformed
    /// row, or where the input ends too soon or too late; [`Error::Io`] where reading fails. After an error the
    /// reader is spent.
    pub fn next_batch(&mut self, rays: &mut Vec<Ray>, max: usize) -> Result<usize, Error> {
        rays.clear();
        self.kept.clear();
        let filled = self.source.fill(rays, &mut self.kept, max, &mut self.admission);
        // A bad ray comes before whatever ended the batch, so it is the first thing wrong.
        if self.admission.stops() {
            let mut more = filled.is_ok() && !rays.is_empty();
            while more {
                rays.clear();
                self.kept.clear();
                let filled = self.source.fill(rays, &mut self.kept, super::BLOCK_ROWS, &mut self.admission);
                more = filled.is_ok() && !rays.is_empty();
            }
            rays.clear();
            return self.admission.error().map_or(Ok(0), Err);
        }
        filled?;
        Ok(rays.len())
    }

    /// Reads these columns, too, to be passed on to the hits ([`take_kept`](Self::take_kept)), in this order.
    ///
    /// To be called before the first batch and before [`select`](Self::select).
    ///
    /// # Errors
    /// [`Error::Bad`] where the table has no such column, or has it twice, or is `.npy`.
    pub fn keep(&mut self, names: &[String]) -> Result<KeptColumns, Error> {
        if names.is_empty() {
            return Ok(KeptColumns::default());
        }
        let there = self.source.columns();
        let place = |name: &String| {
            let mut places = there.iter().enumerate().filter(|(_, column)| *column == name).map(|(i, _)| i);
            let what = match (places.next(), places.next()) {
                (Some(place), None) => return Ok(place),
                (None, _) => format!("there is no column {}", quoted(name)),
                _ => format!("the column {} is there twice", quoted(name)),
            };
            let expected = format!("keep some of {}", quoted(there.join(",")));
            Err(Error::bad(self.admission.path().display().to_string(), "header", what, expected))
        };
        let columns = names.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        self.source.keep(&columns)
    }

    /// The table's columns that are neither of a ray nor kept, as a message says it; `None` where there are none.
    #[must_use]
    pub fn passed_over(&self, kept: &KeptColumns) -> Option<String> {
        let is_kept = |name: &&str| kept.names().iter().any(|kept| kept == name);
        let of_rays = |name: &&str| super::RAY_COLUMNS.iter().any(|column| column.eq_ignore_ascii_case(name));
        let names: Vec<&str> = self.source.columns().into_iter().filter(|n| !of_rays(n) && !is_kept(n)).collect();
        match &names[..] {
            [] => None,
            [name] => Some(format!("the column {} is passed over", quoted(name))),
            names => Some(format!("the columns {} are passed over", quoted(names.join(",")))),
        }
    }

    /// Swaps `kept` for the values of the last batch's columns that are kept.
    pub fn take_kept(&mut self, kept: &mut Kept) {
        std::mem::swap(&mut self.kept, kept);
    }

    /// How many rays it will have handed on at its end: those selected, else what the header says; `None` for a whole CSV table.
    #[must_use]
    pub fn total(&self) -> Option<u64> {
        self.selected.or_else(|| self.source.total())
    }

    /// How many bad rays were handed on as misses so far.
    #[must_use]
    pub fn invalid(&self) -> u64 {
        self.admission.count()
    }

    /// What rounding to the nearest `f32` changed so far; its shift is that of origins.
    #[must_use]
    pub fn rounding(&self) -> Rounding {
        self.admission.rounding()
    }

    /// Subtracts this from every origin, exactly, before it is rounded: what was subtracted from the scene.
    ///
    /// To be called before the first batch.
    pub fn subtract(&mut self, origin: [f64; 3]) {
        self.admission.origin = origin.into();
    }

    /// Makes it an error that rounding moves an origin by more than `most`.
    ///
    /// To be called before the first batch.
    pub fn refuse_shifts_beyond(&mut self, most: f64) {
        self.admission.most = most;
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
