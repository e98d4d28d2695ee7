use std::fs::File;
use std::ops::Range;
use std::path::{Path, PathBuf};

use arrow::array::{Array, Float32Array, Float64Array, RecordBatch};
use arrow::datatypes::{DataType, Schema};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::errors::ParquetError;

use super::admission::Admission;
use super::guarded::guarded;
use super::kept::{Kept, KeptColumns};
use super::ray_reader::Source;
use super::{BLOCK_ROWS, DEFAULT_ROW, RAY_COLUMNS, parquet_claims, places};
use crate::Error;
use crate::decimal::Number;
use rayproof_scene::Ray;

/// What would be right, in a message about the columns.
const EXPECTED: &str = "give float32 or float64 columns ox, oy, oz, dx, dy, dz and, both or neither, t_min, t_max";

/// The rays of a Parquet file, a block of rows at a time.
pub(super) struct ParquetRays {
    path: PathBuf,
    file: File,
    footer: ArrowReaderMetadata,
    /// For each column of the file, its place in [`RAY_COLUMNS`], if it is of a ray.
    places: Vec<Option<usize>>,
    /// The columns that are kept, in the order asked for.
    kept: Vec<usize>,
    reader: ParquetRecordBatchReader,
    /// The block being handed on, as it was read.
    batch: RecordBatch,
    /// Its rays, and how many of them are gone.
    block: Vec<[Number; 8]>,
    gone: usize,
    rows: u64,
    /// The next row to hand on, and the one to stop before.
    next: u64,
    end: u64,
    /// What a place says of values that were rounded.
    note: &'static str,
}

impl ParquetRays {
    /// Reads the footer.
    pub(super) fn open(path: &Path, file: File) -> Result<Self, Error> {
        let name = path.display().to_string();
        let broken = |error: String| broken(path, &error);
        parquet_claims::footer(&file).map_err(broken)?;
        let footer = guarded(|| ArrowReaderMetadata::load(&file, ArrowReaderOptions::new())).map_err(broken)?;
        let places = ray_columns(footer.schema()).map_err(|what| Error::bad(&name, "schema", what, EXPECTED))?;
        let read = columns_read(&footer, &places, &[]);
        parquet_claims::pages(&file, footer.metadata(), &read).map_err(broken)?;
        let rows = footer.metadata().file_metadata().num_rows();
        let rows = u64::try_from(rows)
            .map_err(|_| Error::bad(&name, "footer", format!("it has {rows} rows"), "give a whole Parquet file"))?;
        let fields = footer.schema().fields().iter().zip(&places);
        let double =
            fields.filter(|(_, place)| place.is_some()).any(|(field, _)| *field.data_type() == DataType::Float64);
        let reader = guarded(|| builder(&file, &footer, read)?.build()).map_err(broken)?;
        Ok(Self {
            path: path.to_owned(),
            file,
            batch: RecordBatch::new_empty(footer.schema().clone()),
            footer,
            places,
            kept: Vec::new(),
            reader,
            block: Vec::new(),
            gone: 0,
            rows,
            next: 0,
            end: rows,
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

    /// The numbers of the columns that are read, in the order in which they come.
    fn read(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|i| self.places[*i].is_some() || self.kept.contains(i)).collect()
    }

    /// Reads the next block; `false` at the end.
    fn next_block(&mut self) -> Result<bool, Error> {
        self.block.clear();
        self.gone = 0;
        let reader = &mut self.reader;
        match guarded(|| reader.next().transpose()) {
            Ok(Some(batch)) => {
                self.convert(&batch)?;
                self.batch = batch;
                Ok(true)
            }
            Err(error) => Err(self.bad(format!("it cannot be read: {error}"))),
            Ok(None) if self.next == self.end => Ok(false),
            Ok(None) => Err(self.bad(format!("the data ends here; the footer promises {} rows", self.rows))),
        }
    }

    fn convert(&mut self, batch: &RecordBatch) -> Result<(), Error> {
        self.block.resize(batch.num_rows(), DEFAULT_ROW.map(Number::from));
        let read = self.read();
        for (array, i) in batch.columns().iter().zip(read) {
            let Some(column) = self.places[i] else { continue };
            if array.null_count() > 0 {
                let row = (0..array.len()).find(|&i| array.is_null(i)).unwrap_or(0);
                self.next += row as u64;
                return Err(self.bad(format!("{} is null", RAY_COLUMNS[column])));
            }
            if let Some(values) = array.as_any().downcast_ref::<Float32Array>() {
                self.block.iter_mut().zip(values.values()).for_each(|(row, &x)| row[column] = x.into());
            } else if let Some(values) = array.as_any().downcast_ref::<Float64Array>() {
                self.block.iter_mut().zip(values.values()).for_each(|(row, &x)| row[column] = x.into());
            } else {
                return Err(self.bad(format!("{} is not of the schema's type", RAY_COLUMNS[column])));
            }
        }
        Ok(())
    }

    /// Adds the next rows of the block, of the columns that are kept.
    fn keep_rows(&self, kept: &mut Kept, rows: usize) -> Result<(), Error> {
        if self.kept.is_empty() || rows == 0 {
            return Ok(());
        }
        let read = self.read();
        let among: Vec<usize> = self.kept.iter().filter_map(|column| read.iter().position(|i| i == column)).collect();
        let columns = self.batch.project(&among).map_err(|error| self.bad(error.to_string()))?;
        kept.arrays.push(columns.slice(self.gone, rows));
        Ok(())
    }
}

impl Source for ParquetRays {
    fn columns(&self) -> Vec<&str> {
        self.footer.schema().fields().iter().map(|field| field.name().as_str()).collect()
    }

    fn keep(&mut self, columns: &[usize]) -> Result<KeptColumns, Error> {
        self.kept = columns.to_vec();
        let read = columns_read(&self.footer, &self.places, columns);
        let broken = |error: String| broken(&self.path, &error);
        parquet_claims::pages(&self.file, self.footer.metadata(), &read).map_err(broken)?;
        self.reader = guarded(|| builder(&self.file, &self.footer, read)?.build()).map_err(broken)?;
        Ok(KeptColumns::typed(columns.iter().map(|&i| self.footer.schema().fields()[i].clone()).collect()))
    }

    fn fill(
        &mut self,
        rays: &mut Vec<Ray>,
        kept: &mut Kept,
        max: usize,
        admission: &mut Admission,
    ) -> Result<(), Error> {
        while rays.len() < max {
            if self.gone == self.block.len() && !self.next_block()? {
                break;
            }
            let rows = (self.block.len() - self.gone).min(max - rays.len());
            for &row in &self.block[self.gone..self.gone + rows] {
                let (next, note) = (self.next, self.note);
                rays.push(admission.admit(row, || format!("row {next} (counting from 0{note})")));
                self.next += 1;
            }
            self.keep_rows(kept, rows)?;
            self.gone += rows;
        }
        Ok(())
    }

    fn total(&self) -> Option<u64> {
        Some(self.rows)
    }

    fn select(&mut self, rows: Range<u64>) -> Result<(), Error> {
        let (mut groups, mut offset, mut start) = (Vec::new(), 0, 0_u64);
        for (i, group) in self.footer.metadata().row_groups().iter().enumerate() {
            let held = u64::try_from(group.num_rows()).map_err(|e| broken(&self.path, &e.to_string()))?;
            let end = start.saturating_add(held);
            if end > rows.start && start < rows.end {
                if groups.is_empty() {
                    offset = rows.start - start;
                }
                groups.push(i);
            }
            start = end;
        }
        let of_groups = [offset, rows.end - rows.start].map(usize::try_from);
        let [Ok(offset), Ok(limit)] = of_groups else { return Err(broken(&self.path, "it holds more than memory")) };
        let read = columns_read(&self.footer, &self.places, &self.kept);
        let select = || {
            builder(&self.file, &self.footer, read)?
                .with_row_groups(groups)
                .with_offset(offset)
                .with_limit(limit)
                .build()
        };
        self.reader = guarded(select).map_err(|error| broken(&self.path, &error))?;
        (self.next, self.end) = (rows.start, rows.end);
        Ok(())
    }
}

/// Which columns are read: those of a ray, and those that are kept.
fn columns_read(footer: &ArrowReaderMetadata, places: &[Option<usize>], kept: &[usize]) -> ProjectionMask {
    let read = (0..places.len()).filter(|i| places[*i].is_some() || kept.contains(i));
    ProjectionMask::roots(footer.parquet_schema(), read)
}

/// A reader of a file whose footer was read.
fn builder(
    file: &File,
    footer: &ArrowReaderMetadata,
    read: ProjectionMask,
) -> Result<ParquetRecordBatchReaderBuilder<File>, ParquetError> {
    let builder = ParquetRecordBatchReaderBuilder::new_with_metadata(file.try_clone()?, footer.clone());
    Ok(builder.with_batch_size(BLOCK_ROWS).with_projection(read))
}

fn broken(path: &Path, error: &str) -> Error {
    let (what, expected) =
        (format!("it is not a Parquet file: {error}"), "give a whole Parquet file, not compressed or with snappy");
    Error::bad(path.display().to_string(), "footer", what, expected)
}

/// For each column of the file its place in [`RAY_COLUMNS`], if it is of a ray; or what is wrong.
fn ray_columns(schema: &Schema) -> Result<Vec<Option<usize>>, String> {
    let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
    let places = places(&names)?;
    for (field, _) in schema.fields().iter().zip(&places).filter(|(_, place)| place.is_some()) {
        if !matches!(field.data_type(), DataType::Float32 | DataType::Float64) {
            return Err(format!("the column {} is of type {}", field.name(), field.data_type()));
        }
    }
    Ok(places)
}
