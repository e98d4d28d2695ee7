//! The rays of one run: a file, stdin, or one share of them.

use std::path::Path;

use rayproof::files::RayReader;
use rayproof::scene::{InvalidRays, Ray};

use crate::exit::{Code, Failure};
use crate::parse::Shard;
use crate::pipeline::BATCH;

/// A stream of rays that knows, where that can be known, how many are to come.
pub(crate) struct Source {
    reader: RayReader,
    total: Option<u64>,
    /// How many rays are still to be handed on; all that come where that is not known.
    left: Option<u64>,
    /// What was invalid and rounded among the rays before this share.
    before: (u64, u64),
}

impl Source {
    /// Opens `path` and goes to the first ray of the share.
    pub(crate) fn open(path: &Path, invalid: InvalidRays, shard: Option<Shard>) -> Result<Self, Failure> {
        let reader = RayReader::open(path, None, invalid)?;
        let total = reader.total();
        let mut source = Self { reader, total, left: total, before: (0, 0) };
        if let Some(shard) = shard.filter(|&shard| shard != Shard::WHOLE) {
            let all = match total {
                Some(total) => total,
                None => count(path, invalid)?,
            };
            let rows = shard.rows(all);
            source.left = Some(rows.start);
            let mut skipped = Vec::new();
            while source.left != Some(0) {
                source.next(&mut skipped)?;
            }
            source.before = (source.reader.invalid(), source.reader.rounded_values());
            source.total = Some(rows.end - rows.start);
            source.left = source.total;
        }
        Ok(source)
    }

    /// How many rays there are in all, where that is known.
    pub(crate) const fn total(&self) -> Option<u64> {
        self.total
    }

    /// Replaces what is in `rays` by the next batch, which is empty at the end.
    pub(crate) fn next(&mut self, rays: &mut Vec<Ray>) -> Result<(), Failure> {
        let max = self.left.map_or(BATCH, |left| usize::try_from(left).unwrap_or(usize::MAX).min(BATCH));
        let got = self.reader.next_batch(rays, max)?;
        if got == 0 {
            self.left = Some(0);
        }
        self.left = self.left.map(|left| left - got as u64);
        Ok(())
    }

    /// How many rays so far were invalid, and how many values were rounded.
    pub(crate) fn tally(&self) -> (u64, u64) {
        (self.reader.invalid() - self.before.0, self.reader.rounded_values() - self.before.1)
    }
}

/// Reads a file through to learn how many rays it holds.
fn count(path: &Path, invalid: InvalidRays) -> Result<u64, Failure> {
    if !path.metadata().is_ok_and(|file| file.is_file()) {
        let message = format!(
            "--shard: {}: how many rays there are is not known before the last has come; give a file, or .npy",
            path.display()
        );
        return Err(Failure::new(Code::Usage, message));
    }
    let mut reader = RayReader::open(path, None, invalid)?;
    let mut rays = Vec::new();
    let mut total = 0;
    loop {
        match reader.next_batch(&mut rays, BATCH)? {
            0 => return Ok(total),
            got => total += got as u64,
        }
    }
}
