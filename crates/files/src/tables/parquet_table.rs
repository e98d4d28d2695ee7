use std::io;
use std::sync::Arc;

use arrow::array::{ArrayRef, Float32Array, RecordBatch, UInt8Array, UInt32Array};
use arrow::datatypes::{DataType, Field, FieldRef, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;

use super::kept::Kept;
use super::output::Output;
use super::table::{Kind, Layout};

/// Writes rows as columns: a row group of a million rows at a time is held in memory.
pub(super) struct ParquetTable {
    writer: ArrowWriter<Output>,
    schema: Arc<Schema>,
}

impl ParquetTable {
    pub(super) fn new(layout: &Layout, output: Output) -> io::Result<Self> {
        let fields = layout.columns.iter().map(|&(name, kind)| Field::new(name, data_type(kind), false));
        let fields = fields.map(FieldRef::from).chain(layout.kept.fields());
        let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
        let properties = WriterProperties::builder().set_compression(Compression::SNAPPY).build();
        let writer = ArrowWriter::try_new(output, Arc::clone(&schema), Some(properties)).map_err(io_error)?;
        Ok(Self { writer, schema })
    }

    /// Appends whole rows, and those of `kept` from `first`.
    pub(super) fn write(&mut self, layout: &Layout, rows: &[u8], kept: &Kept, first: usize) -> io::Result<()> {
        let mut offset = 0;
        let mut columns = Vec::with_capacity(layout.columns.len());
        for (_, kind) in &layout.columns {
            columns.push(column(*kind, rows, layout.row_bytes(), offset));
            offset += kind.bytes();
        }
        columns.extend(kept.columns(first, first + rows.len() / layout.row_bytes())?);
        let batch = RecordBatch::try_new(Arc::clone(&self.schema), columns).map_err(io::Error::other)?;
        self.writer.write(&batch).map_err(io_error)
    }

    /// Writes the footer.
    pub(super) fn finish(self) -> io::Result<Output> {
        self.writer.into_inner().map_err(io_error)
    }
}

fn data_type(kind: Kind) -> DataType {
    match kind {
        Kind::F32 => DataType::Float32,
        Kind::U32 => DataType::UInt32,
        Kind::U8 => DataType::UInt8,
    }
}

/// The values at `offset` in each row.
fn column(kind: Kind, rows: &[u8], row_bytes: usize, offset: usize) -> ArrayRef {
    let rows = rows.chunks_exact(row_bytes).map(|row| &row[offset..]);
    let word = |row: &[u8]| [row[0], row[1], row[2], row[3]];
    match kind {
        Kind::F32 => Arc::new(Float32Array::from_iter_values(rows.map(|row| f32::from_le_bytes(word(row))))),
        Kind::U32 => Arc::new(UInt32Array::from_iter_values(rows.map(|row| u32::from_le_bytes(word(row))))),
        Kind::U8 => Arc::new(UInt8Array::from_iter_values(rows.map(|row| row[0]))),
    }
}

/// What the system said, where it is the system that failed.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(io) => *io,
            Err(inner) => io::Error::other(inner),
        },
        error => io::Error::other(error),
    }
}
