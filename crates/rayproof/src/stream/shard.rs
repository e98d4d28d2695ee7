use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use rayproof_files::{self as files, InvalidRays, RayReader};

use crate::batch::share;

/// One of several contiguous shares of a table of rays, written `I/N`, `I` from 0: for as many machines or runs, whose hits,
/// joined, are the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    of: u64,
}

impl Shard {
    /// The one share that is everything.
    pub const WHOLE: Self = Self { index: 0, of: 1 };

    /// Share `index` of `of`; `None` where `index` is not below `of`.
    #[must_use]
    pub const fn new(index: u64, of: u64) -> Option<Self> {
        if index < of { Some(Self { index, of }) } else { None }
    }

    /// The rows of this share of `total`: the shares of one `of` join without a gap and differ by at most one row.
    #[must_use]
    pub fn rows(self, total: u64) -> Range<u64> {
        share(self.index, self.of, total)..share(self.index + 1, self.of, total)
    }

    /// Opens a table of rays, or stdin for `-`, at the first row of this share.
    ///
    /// Rows before it are not decoded: `.npy` and Parquet files are sought in, lines of a CSV file are counted, bytes of a pipe
    /// skipped. So a bad ray outside of the share is no fault of this one, but of the one that holds it. Rows in messages are
    /// numbered as in the whole.
    ///
    /// # Errors
    /// [`ShardError::Endless`] for a part of a CSV pipe; as [`RayReader::open`], [`RayReader::count`] and [`RayReader::select`].
    pub fn open(self, path: &Path, invalid: InvalidRays) -> Result<RayReader, ShardError> {
        let mut reader = RayReader::open(path, None, invalid)?;
        if self != Self::WHOLE {
            let total = reader.count()?.ok_or_else(|| ShardError::Endless { path: path.to_owned() })?;
            reader.select(self.rows(total))?;
        }
        Ok(reader)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

/// Text that is no [`Shard`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("give I/N with I from 0 to N-1, for example 0/4 for the first of four shares")]
pub struct NotAShard;

impl FromStr for Shard {
    type Err = NotAShard;

    fn from_str(text: &str) -> Result<Self, NotAShard> {
        let number = |s: &str| s.bytes().all(|b| b.is_ascii_digit()).then(|| s.parse().ok()).flatten();
        let parts = text.split_once('/').and_then(|(index, of)| Self::new(number(index)?, number(of)?));
        parts.ok_or(NotAShard)
    }
}

/// Why a share of a table could not be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShardError {
    /// The table could not be read.
    #[error(transparent)]
    File(#[from] files::Error),
    /// A CSV pipe tells how many rows it has when it is through.
    #[error("{}: how many rays there are is not known before the last has come; give a file, or .npy", path.display())]
    Endless {
        /// The pipe.
        path: PathBuf,
    },
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn shards_are_strict() {
        assert_eq!("0/1".parse(), Ok(Shard::WHOLE));
        assert_eq!("3/8".parse(), Ok(Shard::new(3, 8).unwrap()));
        for bad in ["", "/", "1", "1/1", "8/8", "0/0", "-1/4", "+1/4", "1/4/2", "1/ 4", "a/b", "0x1/4"] {
            assert_eq!(bad.parse::<Shard>(), Err(NotAShard), "{bad:?}");
        }
    }

    #[test]
    fn shards_join_without_gap_or_overlap() {
        for (total, of) in [(0, 3), (1, 3), (10, 3), (1_000_003, 7), (5, 9), (u64::MAX, 5)] {
            let mut next = 0;
            for index in 0..of {
                let rows = Shard { index, of }.rows(total);
                assert_eq!(rows.start, next, "share {index} of {of} of {total}");
                assert!((rows.end - rows.start).abs_diff(total / of) <= 1);
                next = rows.end;
            }
            assert_eq!(next, total);
        }
    }
}
