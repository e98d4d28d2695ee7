use std::path::Path;

use super::format::Format;
use super::kept::{Kept, KeptColumns};
use super::table::{Kind, Layout, TableWriter};
use super::{BLOCK_ROWS, RAY_COLUMNS, row_of};
use crate::Error;
use rayproof_scene::Ray;

/// Writes rays to a file or stdout, a batch at a time, as [`RayReader`](crate::RayReader) reads them.
///
/// A file is written under another name beside it and takes its own in [`finish`](Self::finish); dropped unfinished,
/// the writer leaves no file and an older one stays as it was.
pub struct RayWriter {
    table: TableWriter,
    columns: usize,
    block: Vec<u8>,
}

impl RayWriter {
    /// Opens a file, or stdout for `-`.
    ///
    /// `with_range` writes `t_min` and `t_max` too; without it they are dropped, and read back as 0 and infinity.
    /// Without a `format` the ending tells it; stdout gets `.npy`. `total` is the number of rows, if known: without
    /// it, rows for a pipe in `.npy` wait in a temporary file, because the header comes first.
    ///
    /// # Errors
    /// [`Error::Bad`] where the ending is not known, [`Error::Io`] where the file cannot be created.
    pub fn create(path: &Path, format: Option<Format>, with_range: bool, total: Option<u64>) -> Result<Self, Error> {
        let columns = if with_range { 8 } else { 6 };
        let layout = Layout {
            columns: RAY_COLUMNS[..columns].iter().map(|&c| (c, Kind::F32)).collect(),
            kept: KeptColumns::default(),
            matrix: true,
        };
        Ok(Self { table: TableWriter::create(path, format, layout, total)?, columns, block: Vec::new() })
    }

    /// Appends rays.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    pub fn write(&mut self, rays: &[Ray]) -> Result<(), Error> {
        for rays in rays.chunks(BLOCK_ROWS) {
            self.block.clear();
            for ray in rays {
                let row = row_of(ray).map(f32::to_le_bytes);
                self.block.extend_from_slice(row[..self.columns].as_flattened());
            }
            self.table.write(&self.block, &Kept::default(), 0)?;
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
}
