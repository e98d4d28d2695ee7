use std::ops::Range;
use std::path::Path;

use super::BLOCK_ROWS;
use super::format::Format;
use super::table::{Kind, Layout, TableWriter};
use crate::Error;
use rayproof_scene::{Hit, MISS, Scene};

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
    fn layout(self) -> Layout {
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
        Layout { columns, matrix: false }
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
    /// Opens a file, or stdout for `-`.
    ///
    /// Without a `format` the ending tells it; stdout gets `.npy`. `total` is the number of rows, if known: without
    /// it, rows for a pipe in `.npy` wait in a temporary file, because the header comes first.
    ///
    /// # Errors
    /// [`Error::Bad`] where the ending is not known, [`Error::Io`] where the file cannot be created.
    pub fn create(path: &Path, format: Option<Format>, kind: HitKind, total: Option<u64>) -> Result<Self, Error> {
        Ok(Self { kind, table: TableWriter::create(path, format, kind.layout(), total)?, block: Vec::new() })
    }

    /// Appends the closest hits, whose primitives have the flat numbers of `scene`.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`], or a primitive is not in the scene.
    pub fn write_closest(&mut self, scene: &Scene, hits: &[Hit]) -> Result<(), Error> {
        self.expect(HitKind::Closest);
        let mut last = Span { geometry: 0, flat: 0..0 };
        for hits in hits.chunks(BLOCK_ROWS) {
            self.block.clear();
            for hit in hits {
                let (geometry, primitive) = match hit.primitive {
                    MISS => (MISS, MISS),
                    flat => last.locate(scene, flat),
                };
                let hit = if hit.is_hit() { hit } else { &Hit::MISS };
                let words = [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), geometry, primitive];
                self.block.extend_from_slice(words.map(u32::to_le_bytes).as_flattened());
            }
            self.table.write(&self.block)?;
        }
        Ok(())
    }

    /// Appends whether there was any hit, 0 or 1 a ray.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`].
    pub fn write_any(&mut self, hits: &[u8]) -> Result<(), Error> {
        self.expect(HitKind::Any);
        hits.chunks(BLOCK_ROWS).try_for_each(|hits| self.table.write(hits))
    }

    /// Appends how many crossings there were.
    ///
    /// # Errors
    /// [`Error::Io`] where writing fails.
    ///
    /// # Panics
    /// When the writer is for another [`HitKind`].
    pub fn write_count(&mut self, counts: &[u32]) -> Result<(), Error> {
        self.expect(HitKind::Count);
        for counts in counts.chunks(BLOCK_ROWS) {
            self.block.clear();
            self.block.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
            self.table.write(&self.block)?;
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

    fn expect(&self, kind: HitKind) {
        assert_eq!(self.kind, kind, "this writer is for another kind of hit");
    }
}

/// The geometry of the last hit: neighbours in a batch mostly hit the same one.
struct Span {
    geometry: usize,
    flat: Range<usize>,
}

impl Span {
    #[expect(clippy::cast_possible_truncation, reason = "neither index is above the flat number, which is a u32")]
    fn locate(&mut self, scene: &Scene, flat: u32) -> (u32, u32) {
        let flat = flat as usize;
        if !self.flat.contains(&flat) {
            let (geometry, primitive) = scene.locate(flat);
            let start = flat - primitive;
            *self = Self { geometry, flat: start..start + scene.geometries()[geometry].len() };
        }
        (self.geometry as u32, (flat - self.flat.start) as u32)
    }
}
