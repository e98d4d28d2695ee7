//! Columns of a table of rays that are none of a ray's, passed on to the hits.

use std::io::{self, Write};

#[cfg(feature = "parquet")]
use arrow::{
    array::{ArrayRef, RecordBatch, StringArray},
    datatypes::{DataType, Field, FieldRef},
    util::display::{ArrayFormatter, FormatOptions},
};

/// The columns of a table of rays that are passed on to the hits: what [`RayReader::keep`](crate::RayReader::keep) found.
#[derive(Clone, Debug, Default)]
pub struct KeptColumns {
    names: Vec<String>,
    /// Their types, where the table has some; else all are text.
    #[cfg(feature = "parquet")]
    fields: Option<Vec<FieldRef>>,
}

impl KeptColumns {
    pub(super) fn text(names: Vec<String>) -> Self {
        Self { names, ..Self::default() }
    }

    #[cfg(feature = "parquet")]
    pub(super) fn typed(fields: Vec<FieldRef>) -> Self {
        Self { names: fields.iter().map(|field| field.name().clone()).collect(), fields: Some(fields) }
    }

    /// Their names, in the order in which they follow the hits' own.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The columns of a Parquet table.
    #[cfg(feature = "parquet")]
    pub(super) fn fields(&self) -> Vec<FieldRef> {
        let text = || self.names.iter().map(|name| Field::new(name, DataType::Utf8, false).into()).collect();
        self.fields.clone().unwrap_or_else(text)
    }
}

/// The values of [`KeptColumns`], for a batch of rays.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// A column's values, each as it is written.
    pub(super) text: Vec<Texts>,
    /// Rows that follow each other.
    #[cfg(feature = "parquet")]
    pub(super) arrays: Vec<RecordBatch>,
}

/// Pieces of text, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Texts {
    bytes: Vec<u8>,
    ends: Vec<usize>,
}

impl Texts {
    pub(super) fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
        self.ends.push(self.bytes.len());
    }

    fn get(&self, i: usize) -> &[u8] {
        &self.bytes[i.checked_sub(1).map_or(0, |before| self.ends[before])..self.ends[i]]
    }
}

impl Kept {
    /// Forgets all rows.
    pub(super) fn clear(&mut self) {
        self.text.clear();
        #[cfg(feature = "parquet")]
        self.arrays.clear();
    }

    /// How many rows there are; `None` where no column is kept.
    fn rows(&self) -> Option<usize> {
        #[cfg(feature = "parquet")]
        if !self.arrays.is_empty() {
            return Some(self.arrays.iter().map(RecordBatch::num_rows).sum());
        }
        self.text.first().map(|texts| texts.ends.len())
    }

    /// Says that there are not the same rows of hits and of kept columns.
    pub(super) fn expect(&self, columns: &KeptColumns, hits: usize) {
        let rows = self.rows().unwrap_or(if columns.names.is_empty() { hits } else { 0 });
        assert_eq!(rows, hits, "rows of kept columns {:?}, and hits", columns.names);
    }

    /// For each row the text that follows the hits' own in a line.
    pub(super) fn lines(&self) -> io::Result<KeptText<'_>> {
        Ok(KeptText {
            text: &self.text,
            #[cfg(feature = "parquet")]
            arrays: self.arrays.iter().map(formatters).collect::<Result<_, _>>().map_err(io::Error::other)?,
        })
    }

    /// The rows `from..to` as arrays of [`KeptColumns::fields`].
    #[cfg(feature = "parquet")]
    pub(super) fn columns(&self, from: usize, to: usize) -> io::Result<Vec<ArrayRef>> {
        if self.arrays.is_empty() {
            let column = |texts: &Texts| -> io::Result<ArrayRef> {
                let texts = (from..to).map(|i| std::str::from_utf8(texts.get(i)).map_err(io::Error::other));
                Ok(std::sync::Arc::new(StringArray::from_iter_values(texts.collect::<io::Result<Vec<_>>>()?)))
            };
            return self.text.iter().map(column).collect();
        }
        let (mut pieces, mut start) = (Vec::new(), 0);
        for rows in &self.arrays {
            let end = start + rows.num_rows();
            let (first, last) = (from.max(start), to.min(end));
            if first < last {
                pieces.push(rows.slice(first - start, last - first));
            }
            start = end;
        }
        let whole = arrow::compute::concat_batches(&self.arrays[0].schema(), &pieces).map_err(io::Error::other)?;
        Ok(whole.columns().to_vec())
    }
}

#[cfg(feature = "parquet")]
type Formatted<'a> = (usize, Vec<ArrayFormatter<'a>>);

#[cfg(feature = "parquet")]
fn formatters(rows: &RecordBatch) -> Result<Formatted<'_>, arrow::error::ArrowError> {
    const OPTIONS: FormatOptions<'_> = FormatOptions::new();
    let columns =
        rows.columns().iter().map(|array| ArrayFormatter::try_new(array, &OPTIONS)).collect::<Result<_, _>>()?;
    Ok((rows.num_rows(), columns))
}

/// Rows of kept columns, as text.
pub(super) struct KeptText<'a> {
    text: &'a [Texts],
    #[cfg(feature = "parquet")]
    arrays: Vec<Formatted<'a>>,
}

impl KeptText<'_> {
    /// Writes a comma and the value of each column of a row.
    #[cfg_attr(not(feature = "parquet"), expect(unused_mut, reason = "rows are counted from the first of their batch"))]
    pub(super) fn write(&self, output: &mut impl Write, mut row: usize) -> io::Result<()> {
        for texts in self.text {
            write_field(output, texts.get(row))?;
        }
        #[cfg(feature = "parquet")]
        for (rows, columns) in &self.arrays {
            if row < *rows {
                for column in columns {
                    write_field(output, column.value(row).to_string().as_bytes())?;
                }
                break;
            }
            row -= rows;
        }
        Ok(())
    }
}

/// Writes a comma and a value, in quotes where it needs some.
pub(super) fn write_field(output: &mut impl Write, field: &[u8]) -> io::Result<()> {
    output.write_all(b",")?;
    if !field.iter().any(|byte| b",\"\r\n#".contains(byte)) {
        return output.write_all(field);
    }
    output.write_all(b"\"")?;
    for (i, part) in field.split(|&byte| byte == b'"').enumerate() {
        output.write_all(if i > 0 { b"\"\"" } else { b"" })?;
        output.write_all(part)?;
    }
    output.write_all(b"\"")
}
