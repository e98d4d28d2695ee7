use std::io::{self, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::admission::Admission;
use super::input::Input;
use super::kept::{Kept, KeptColumns};
use super::npy::{Header, HeaderError};
use super::ray_reader::Source;
use super::{BLOCK_ROWS, DEFAULT_ROW};
use crate::Error;
use crate::decimal::Number;
use rayproof_scene::Ray;

/// What would be right, in every message about an array that is not a table of rays.
const EXPECTED: &str = "give shape (N, 6) or (N, 8), little-endian float32, C order, for example \
                        numpy.save(path, numpy.ascontiguousarray(rays, '<f4'))";

/// The rays of an `.npy` file, as a stream.
pub(super) struct NpyRays {
    path: PathBuf,
    input: Input,
    /// 6 or 8.
    columns: usize,
    /// Bytes a value: 4 or 8.
    width: usize,
    rows: u64,
    /// The next row to read, and the one to stop before.
    next: u64,
    end: u64,
    block: Vec<u8>,
}

impl NpyRays {
    /// Reads the header; `size` is the length of the whole file in bytes, where there is one.
    pub(super) fn open(path: &Path, mut input: Input, size: Option<u64>) -> Result<Self, Error> {
        let header = Header::read(&mut input).map_err(|error| match error {
            HeaderError::Bad(what) => Error::bad(path.display().to_string(), "header", what, EXPECTED),
            HeaderError::Io(source) => Error::Io { path: path.to_owned(), source },
        })?;
        let bad = |what: String| Error::bad(path.display().to_string(), "header", what, EXPECTED);
        let width = match header.descr.trim_matches(['\'', '"']) {
            "<f4" => 4,
            "<f8" => 8,
            ">f4" | ">f8" => return Err(bad(format!("{}, which is big-endian", header.wrong_descr()))),
            _ => return Err(bad(header.wrong_descr())),
        };
        let (rows, columns) = match header.dimensions().as_deref() {
            Some(&[rows, 6]) => (rows, 6),
            Some(&[rows, 8]) => (rows, 8),
            _ => return Err(bad(header.wrong_shape())),
        };
        if header.fortran_order {
            return Err(bad("the array is in Fortran order".to_owned()));
        }
        let (path, block) = (path.to_owned(), Vec::new());
        let rays = Self { path, input, columns, width, rows, next: 0, end: rows, block };
        let data = rows
            .checked_mul(rays.row_bytes() as u64)
            .ok_or_else(|| bad(format!("{}, more than a file can hold", header.wrong_shape())))?;
        match size.map(|size| size.saturating_sub(header.bytes)) {
            Some(there) if there != data => Err(rays.wrong_size(&there.to_string(), there / rays.row_bytes() as u64)),
            _ => Ok(rays),
        }
    }

    fn row_bytes(&self) -> usize {
        self.columns * self.width
    }

    fn wrong_size(&self, bytes: &str, whole: u64) -> Error {
        let (rows, row_bytes) = (self.rows, self.row_bytes());
        let expected = u128::from(rows) * row_bytes as u128;
        Error::bad(
            self.path.display().to_string(),
            "data",
            format!(
                "the header promises {rows} rows of {row_bytes} bytes, {expected} bytes of data; \
                 there are {bytes} bytes, {whole} whole rows"
            ),
            "give a whole file, with as many rows as its header says",
        )
    }

    /// Reads the next block of `rows` rows; returns the bytes that were there.
    fn read_block(&mut self, rows: usize) -> Result<usize, Error> {
        self.block.resize(rows * self.row_bytes(), 0);
        let mut got = 0;
        while got < self.block.len() {
            match self.input.read(&mut self.block[got..]) {
                Ok(0) => break,
                Ok(n) => got += n,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(source) => return Err(Error::Io { path: self.path.clone(), source }),
            }
        }
        Ok(got)
    }

    /// Appends the whole rows in the first `bytes` bytes of the block.
    fn decode(&mut self, bytes: usize, rays: &mut Vec<Ray>, admission: &mut Admission) {
        for row in self.block[..bytes].chunks_exact(self.columns * self.width) {
            let next = self.next;
            rays.push(if self.width == 4 {
                let mut values = DEFAULT_ROW;
                for (value, x) in values.iter_mut().zip(row.as_chunks::<4>().0) {
                    *value = f32::from_le_bytes(*x);
                }
                admission.admit_singles(values, || format!("row {next} (counting from 0)"))
            } else {
                let mut values = DEFAULT_ROW.map(Number::from);
                for (value, x) in values.iter_mut().zip(row.as_chunks::<8>().0) {
                    *value = f64::from_le_bytes(*x).into();
                }
                admission.admit(values, || format!("row {next} (counting from 0, rounded to float32)"))
            });
            self.next += 1;
        }
    }

    /// Whether nothing follows the last row: known for a file, to be tried on a pipe.
    fn check_end(&mut self) -> Result<(), Error> {
        if self.read_block(1)? > 0 {
            let data = u128::from(self.rows) * self.row_bytes() as u128;
            return Err(self.wrong_size(&format!("more than {data}"), self.rows));
        }
        Ok(())
    }
}

impl Source for NpyRays {
    fn columns(&self) -> Vec<&str> {
        super::RAY_COLUMNS[..self.columns].to_vec()
    }

    fn keep(&mut self, _: &[usize]) -> Result<KeptColumns, Error> {
        let what = ".npy rays have no columns to pass on";
        Err(Error::bad(self.path.display().to_string(), "header", what, "give .csv or .parquet"))
    }

    fn fill(&mut self, rays: &mut Vec<Ray>, _: &mut Kept, max: usize, admission: &mut Admission) -> Result<(), Error> {
        while rays.len() < max && self.next < self.end {
            let left = usize::try_from(self.end - self.next).unwrap_or(usize::MAX);
            let rows = left.min(max - rays.len()).min(BLOCK_ROWS);
            let got = self.read_block(rows)?;
            let before = self.next;
            self.decode(got, rays, admission);
            if got < self.block.len() {
                let there = u128::from(before) * self.row_bytes() as u128 + got as u128;
                return Err(self.wrong_size(&there.to_string(), self.next));
            }
        }
        if self.next == self.rows { self.check_end() } else { Ok(()) }
    }

    fn total(&self) -> Option<u64> {
        Some(self.rows)
    }

    fn select(&mut self, rows: Range<u64>) -> Result<(), Error> {
        let row_bytes = self.row_bytes() as u64;
        let before = (rows.start - self.next) * row_bytes;
        let there = self.input.skip(before).map_err(|source| Error::Io { path: self.path.clone(), source })?;
        if there < before {
            return Err(self.wrong_size(&there.to_string(), there / row_bytes));
        }
        (self.next, self.end) = (rows.start, rows.end);
        Ok(())
    }
}
