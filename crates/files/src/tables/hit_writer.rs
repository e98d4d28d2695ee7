use std::path::Path;

use super::BLOCK_ROWS;
use super::format::Format;
use super::kept::{Kept, KeptColumns};
use super::table::{Kind, Layout, TableWriter};
use crate::Error;
use rayproof_scene::Hit;

/// Which question the hits answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitKind {
    /// Where the ray first hits: columns `t, u, v` (`f32`), `geometry, primitive` (`u32`).
    Closest,
    /// Whether it hits: column `hit` (`u8`, 0 or 1).
    Any,
    /// How often it crosses the surface: column `count` (`u32`).
    Count,
}

impl HitKind {
    fn layout(self, kept: KeptColumns) -> Layout {
        let columns = match self {
            Self::Closest => vec![
                ("t", Kind::F32),
                ("u", Kind::F32),
                ("v", Kind::F32),
                ("geometry", Kind::U32),
                ("primitive", Kind::U32),
            ],
            Self::Any => vec![("hit", Kind::U8)],
            Self::Count => vec![("count", Kind::U32)],
        };
        Layout { columns, kept, matrix: false }
    }
}

/// Writes hits to a file or stdout, a batch at a time: one row a ray, in the rays' order.
///
/// A file is written under another name beside it and takes its own in [`finish`](Self::finish); dropped unfinished,
/// the writer leaves no file and an older one stays as it was.
pub struct HitWriter {
    kind: HitKind,
    table: TableWriter,
    block: Vec<u8>,
}

impl HitWriter {
    /// Opens a file, or stdout for `-`. After the columns of the hits come those of the rays that are `kept`.
    ///
    /// Without a `format` the ending tells it; stdout gets `.npy`. `total` is the number of rows, if known: without
    /// it, rows for a pipe in `.npy` wait in a temporary file, because the header comes first.
    ///
    /// # Errors
    /// [`Error::Bad`] where the ending is not known, or where columns are kept that `.npy` has no place for or that have the name
    /// of one of the hits'; [`Error::Io`] where the file cannot be created.
    pub fn create(
        path: &Path,
        format: Option<Format>,
        kind: HitKind,
        total: Option<u64>,
        kept: &KeptColumns,
    ) -> Result<Self, Error> {
        let table = TableWriter::create(path, format, kind.layout(kept.clone()), total)?;
        Ok(Self { kind, table, block: Vec::new() })
    }

    /// Appends the closest hits.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`], or `kept` has not as many rows.
    pub fn write_closest(&mut self, hits: &[Hit], kept: &Kept) -> Result<(), Error> {
        self.expect(HitKind::Closest, hits.len(), kept);
        for (hits, first) in blocks(hits) {
            self.block.clear();
            self.block.extend(hits.iter().flat_map(|&Hit { t, u, v, geometry, primitive }| {
                bytes_of_row([t.to_bits(), u.to_bits(), v.to_bits(), geometry, primitive])
            }));
            self.table.write(&self.block, kept, first)?;
        }
        Ok(())
    }

    /// Appends whether there was any hit, 0 or 1 a ray.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`], or `kept` has not as many rows.
    pub fn write_any(&mut self, hits: &[u8], kept: &Kept) -> Result<(), Error> {
        self.expect(HitKind::Any, hits.len(), kept);
        blocks(hits).try_for_each(|(hits, first)| self.table.write(hits, kept, first))
    }

    /// Appends how many crossings there were.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`], or `kept` has not as many rows.
    pub fn write_count(&mut self, counts: &[u32], kept: &Kept) -> Result<(), Error> {
        self.expect(HitKind::Count, counts.len(), kept);
        for (counts, first) in blocks(counts) {
            self.block.clear();
            self.block.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
            self.table.write(&self.block, kept, first)?;
        }
        Ok(())
    }

    /// Completes the table and gives the file its name, in place of an older one.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails, or where there are not as many rows as were announced.
    pub fn finish(self) -> Result<(), Error> {
        self.table.finish()
    }

    fn expect(&self, kind: HitKind, rows: usize, kept: &Kept) {
        assert_eq!(self.kind, kind, "this writer is for another kind of hit");
        kept.expect(self.table.kept(), rows);
    }
}

/// Pieces of [`BLOCK_ROWS`] at most, and the row that each starts with.
fn blocks<T>(rows: &[T]) -> impl Iterator<Item = (&[T], usize)> {
    rows.chunks(BLOCK_ROWS).zip((0..).step_by(BLOCK_ROWS))
}

/// The words of a row, little-endian.
fn bytes_of_row(words: [u32; 5]) -> [u8; 20] {
    let mut bytes = [0; 20];
    bytes.as_chunks_mut().0.iter_mut().zip(words).for_each(|(bytes, word)| *bytes = word.to_le_bytes());
    bytes
}
