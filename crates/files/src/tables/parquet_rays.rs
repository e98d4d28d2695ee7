use std::fmt::Display;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use arrow::array::{Array, Float32Array, Float64Array, RecordBatch};
use arrow::datatypes::{DataType, Schema};
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};

use super::faults::Faults;
use super::ray_reader::Source;
use super::{BLOCK_ROWS, DEFAULT_ROW, RAY_COLUMNS, places, ray_of, round};
use crate::Error;
use rayproof_scene::Ray;

/// What would be right, in a message about the columns.
const EXPECTED: &str = "give float32 or float64 columns ox, oy, oz, dx, dy, dz and, both or neither, t_min, t_max";

/// The rays of a Parquet file, a block of rows at a time.
pub(super) struct ParquetRays {
    path: PathBuf,
    reader: ParquetRecordBatchReader,
    /// For each column of the file, its place in [`RAY_COLUMNS`].
    columns: Vec<usize>,
    /// The block being handed on: its rows, and how many of them are gone.
    block: Vec<[f32; 8]>,
    gone: usize,
    rows: u64,
    next: u64,
    rounded: u64,
    /// What a place says of values that were rounded.
    note: &'static str,
}

impl ParquetRays {
    /// Reads the footer.
    pub(super) fn open(path: &Path, file: File) -> Result<Self, Error> {
        let name = path.display().to_string();
        let whole = "give a whole Parquet file, not compressed or with snappy";
        let broken = |error| Error::bad(&name, "footer", format!("it is not a Parquet file: {error}"), whole);
        let builder = guarded(|| ParquetRecordBatchReaderBuilder::try_new(file)).map_err(broken)?;
        let columns = columns(builder.schema()).map_err(|what| Error::bad(&name, "schema", what, EXPECTED))?;
        let rows = builder.metadata().file_metadata().num_rows();
        let rows = u64::try_from(rows)
            .map_err(|_| Error::bad(&name, "footer", format!("it has {rows} rows"), "give a whole Parquet file"))?;
        let double = builder.schema().fields().iter().any(|field| *field.data_type() == DataType::Float64);
        let reader = guarded(|| builder.with_batch_size(BLOCK_ROWS).build()).map_err(broken)?;
        Ok(Self {
            path: path.to_owned(),
            reader,
            columns,
            block: Vec::new(),
            gone: 0,
            rows,
            next: 0,
            rounded: 0,
            note: if double { ", rounded to float32" } else { "" },
        })
    }

    fn bad(&self, what: String) -> Error {
        let place = format!("row {} (counting from 0)", self.next);
        Error::bad(
            self.path.display().to_string(),
            place,
            what,
            "give a whole Parquet file without nulls, not compressed or with snappy",
        )
    }

    /// Reads the next block; `false` at the end.
    fn next_block(&mut self) -> Result<bool, Error> {
        self.block.clear();
        self.gone = 0;
        let reader = &mut self.reader;
        match guarded(|| reader.next().transpose()) {
            Ok(Some(batch)) => self.convert(&batch).map(|()| true),
            Err(error) => Err(self.bad(format!("it cannot be read: {error}"))),
            Ok(None) if self.next == self.rows => Ok(false),
            Ok(None) => Err(self.bad(format!("the data ends here; the footer promises {} rows", self.rows))),
        }
    }

    fn convert(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        self.block.resize(batch.num_rows(), DEFAULT_ROW);
        for (array, &column) in batch.columns().iter().zip(&self.columns) {
            if array.null_count() > 0 {
                let row = (0..array.len()).find(|&i| array.is_null(i)).unwrap_or(0);
                self.next += row as u64;
                return Err(self.bad(format!("{} is null", RAY_COLUMNS[column])));
            }
            if let Some(values) = array.as_any().downcast_ref::<Float32Array>() {
                self.block.iter_mut().zip(values.values()).for_each(|(row, &x)| row[column] = x);
            } else if let Some(values) = array.as_any().downcast_ref::<Float64Array>() {
                let changed = &mut self.rounded;
                self.block.iter_mut().zip(values.values()).for_each(|(row, &x)| row[column] = round(x, changed));
            } else {
                return Err(self.bad(format!("{} is not of the schema's type", RAY_COLUMNS[column])));
            }
        }
        Ok(())
    }
}

impl Source for ParquetRays {
    fn fill(&mut self, rays: &mut Vec<Ray>, max: usize, faults: &mut Faults) -> Result<(), Error> {
        while rays.len() < max {
            if self.gone == self.block.len() && !self.next_block()? {
                break;
            }
            let rows = (self.block.len() - self.gone).min(max - rays.len());
            for &row in &self.block[self.gone..self.gone + rows] {
                let (next, note) = (self.next, self.note);
                rays.push(faults.admit(ray_of(row), || format!("row {next} (counting from 0{note})")));
                self.next += 1;
            }
            self.gone += rows;
        }
        Ok(())
    }

    fn total(&self) -> Option<u64> {
        Some(self.rows)
    }

    fn rounded_values(&self) -> u64 {
        self.rounded
    }
}

/// What the parquet crate answers. It panics on some damaged files, and a file is never a reason to crash.
fn guarded<T, E: Display>(read: impl FnOnce() -> Result<T, E>) -> Result<T, String> {
    match catch_unwind(AssertUnwindSafe(read)) {
        Ok(result) => result.map_err(|error| error.to_string()),
        Err(_) => Err("it is damaged".to_owned()),
    }
}

/// For each column of the file its place in [`RAY_COLUMNS`], or what is wrong.
fn columns(schema: &Schema) -> Result<Vec<usize>, String> {
    let mut columns = Vec::new();
    for field in schema.fields() {
        match field.data_type() {
            DataType::Float32 | DataType::Float64 => {}
            other => return Err(format!("the column {} is of type {other}", field.name())),
        }
        columns.push(field.name().as_str());
    }
    places(&columns)
}
