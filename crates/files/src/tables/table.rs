use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::format::{Format, is_standard_stream};
use super::kept::{Kept, KeptColumns, write_field};
use super::output::Output;
#[cfg(feature = "parquet")]
use super::parquet_table::ParquetTable;
use crate::Error;
use crate::quote::quoted;

/// The type of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    F32,
    U32,
    U8,
}

impl Kind {
    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::F32 | Self::U32 => 4,
            Self::U8 => 1,
        }
    }

    /// NumPy's name.
    const fn descr(self) -> &'static str {
        match self {
            Self::F32 => "<f4",
            Self::U32 => "<u4",
            Self::U8 => "|u1",
        }
    }
}

/// The columns of a table. A row is its values one after the other, little-endian, as in `.npy`.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) columns: Vec<(&'static str, Kind)>,
    /// What of the rays follows them.
    pub(super) kept: KeptColumns,
    /// Whether `.npy` holds a matrix of one type, shape `(N, columns)`; else named fields, shape `(N,)`.
    pub(super) matrix: bool,
}

impl Layout {
    pub(super) fn row_bytes(&self) -> usize {
        self.columns.iter().map(|(_, kind)| kind.bytes()).sum()
    }

    /// Whether there is a place for the columns that are kept; else what is wrong, and what would be right.
    fn can_keep(&self, format: Format) -> Result<(), [String; 2]> {
        let names = self.kept.names();
        if format == Format::Npy && !names.is_empty() {
            return Err([".npy has no place for them".into(), "write .csv or .parquet".into()]);
        }
        let taken =
            |(i, name): (usize, &String)| self.columns.iter().any(|(own, _)| own == name) || names[..i].contains(name);
        match names.iter().enumerate().find(|&column| taken(column)) {
            Some((_, name)) => {
                Err([format!("there would be two columns {}", quoted(name)), "give it another name".into()])
            }
            None => Ok(()),
        }
    }

    fn npy_header(&self, rows: u64) -> Vec<u8> {
        if self.matrix {
            let columns = self.columns.len();
            super::npy::header(&format!("'{}'", Kind::F32.descr()), |rows| format!("({rows}, {columns})"), rows)
        } else {
            let fields = self.columns.iter().map(|(name, kind)| format!("('{name}', '{}')", kind.descr()));
            let descr = format!("[{}]", fields.collect::<Vec<_>>().join(", "));
            super::npy::header(&descr, |rows| format!("({rows},)"), rows)
        }
    }
}

/// What turns rows into bytes of a file.
enum Encoder {
    Npy(Output),
    Csv(Output),
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetTable>),
}

/// Writes a table row by row in any format. Dropped unfinished, it leaves no file.
pub(super) struct TableWriter {
    path: PathBuf,
    layout: Layout,
    encoder: Encoder,
    rows: u64,
    total: Option<u64>,
}

impl TableWriter {
    /// Opens `path`; `format` defaults to its ending, `.npy` for stdout.
    pub(super) fn create(
        path: &Path,
        format: Option<Format>,
        layout: Layout,
        total: Option<u64>,
    ) -> Result<Self, Error> {
        let format = match format {
            Some(format) => format,
            None if is_standard_stream(path) => Format::Npy,
            None => Format::of(path)?,
        };
        #[cfg(not(feature = "parquet"))]
        if format == Format::Parquet {
            return Err(super::format::no_parquet(path));
        }
        layout.can_keep(format).map_err(|[what, expected]| {
            Error::bad(path.display().to_string(), "the columns that are kept", what, expected)
        })?;
        let io_error = |source| Error::Io { path: path.to_owned(), source };
        // The header of .npy holds the number of rows: in a pipe it must be known at once, or the rows must wait.
        let output = Output::create(path, format == Format::Npy && total.is_none()).map_err(io_error)?;
        Self::new(path, format, layout, total, output).map_err(io_error)
    }

    /// As [`create`](Self::create), into an output that is open.
    pub(super) fn new(
        path: &Path,
        format: Format,
        layout: Layout,
        total: Option<u64>,
        mut output: Output,
    ) -> io::Result<Self> {
        let encoder = match format {
            Format::Npy => {
                output.write_all(&layout.npy_header(total.unwrap_or(0)))?;
                Encoder::Npy(output)
            }
            Format::Csv => {
                let names: Vec<&str> = layout.columns.iter().map(|(name, _)| *name).collect();
                output.write_all(names.join(",").as_bytes())?;
                layout.kept.names().iter().try_for_each(|name| write_field(&mut output, name.as_bytes()))?;
                output.write_all(b"\n")?;
                Encoder::Csv(output)
            }
            #[cfg(feature = "parquet")]
            Format::Parquet => Encoder::Parquet(Box::new(ParquetTable::new(&layout, output)?)),
            #[cfg(not(feature = "parquet"))]
            Format::Parquet => return Err(io::ErrorKind::Unsupported.into()),
        };
        Ok(Self { path: path.to_owned(), layout, encoder, rows: 0, total })
    }

    /// Appends whole rows, [`BLOCK_ROWS`](super::BLOCK_ROWS) at most, so that memory is bounded, and the rows of `kept` from `first`.
    pub(super) fn write(&mut self, rows: &[u8], kept: &Kept, first: usize) -> Result<(), Error> {
        let row_bytes = self.layout.row_bytes();
        assert!(rows.len().is_multiple_of(row_bytes), "{} bytes are no whole rows of {row_bytes}", rows.len());
        self.rows += (rows.len() / row_bytes) as u64;
        let written = match &mut self.encoder {
            Encoder::Npy(output) => output.write_all(rows),
            Encoder::Csv(output) => {
                let mut rows = rows.chunks_exact(row_bytes).enumerate();
                kept.lines().and_then(|kept| {
                    rows.try_for_each(|(i, row)| {
                        write_row(output, &self.layout.columns, row)?;
                        kept.write(output, first + i)?;
                        output.write_all(b"\n")
                    })
                })
            }
            #[cfg(feature = "parquet")]
            Encoder::Parquet(table) => table.write(&self.layout, rows, kept, first),
        };
        written.map_err(|source| Error::Io { path: self.path.clone(), source })
    }

    pub(super) const fn kept(&self) -> &KeptColumns {
        &self.layout.kept
    }

    /// Completes the file and gives it its name.
    pub(super) fn finish(self) -> Result<(), Error> {
        let path = self.path.clone();
        self.complete().map_err(|source| Error::Io { path, source })
    }

    fn complete(self) -> io::Result<()> {
        if let Some(total) = self.total
            && total != self.rows
        {
            return Err(io::Error::other(format!("{} rows were written of {total} that were announced", self.rows)));
        }
        match self.encoder {
            Encoder::Npy(mut output) => {
                output.rewrite_start(&self.layout.npy_header(self.rows))?;
                output.finish()
            }
            Encoder::Csv(output) => output.finish(),
            #[cfg(feature = "parquet")]
            Encoder::Parquet(table) => table.finish()?.finish(),
        }
    }
}

/// Writes one row as text without an end, each `f32` in the fewest digits that read back to the same bits.
fn write_row(output: &mut Output, columns: &[(&'static str, Kind)], row: &[u8]) -> io::Result<()> {
    let mut rest = row;
    for (i, (_, kind)) in columns.iter().enumerate() {
        let (value, after) = rest.split_at(kind.bytes());
        rest = after;
        if i > 0 {
            output.write_all(b",")?;
        }
        match (kind, value) {
            (Kind::F32, &[a, b, c, d]) => write!(output, "{:?}", f32::from_le_bytes([a, b, c, d]))?,
            (Kind::U32, &[a, b, c, d]) => write!(output, "{}", u32::from_le_bytes([a, b, c, d]))?,
            (_, bytes) => write!(output, "{}", bytes[0])?,
        }
    }
    Ok(())
}
