//! The rays of a CSV file.
//!
//! Lines are split here and not by the csv crate: its line numbers are wrong after an empty line and for `\r\n`, and
//! a message that names the wrong line is worse than none. A table of numbers needs no more than commas.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use super::faults::Faults;
use super::ray_reader::{Input, Source};
use super::{DEFAULT_ROW, RAY_COLUMNS, places, ray_of};
use crate::{BadInput, Error};
use rayproof_scene::{Ray, number};

/// The longest line that is read, in bytes: what is longer is no table of rays.
const MAX_LINE: usize = 1 << 16;

/// What would be right, in a message about the header.
const HEADER: &str = "give a first line with ox,oy,oz,dx,dy,dz or ox,oy,oz,dx,dy,dz,t_min,t_max";

/// The rays of a CSV file, as a stream.
pub(super) struct CsvRays {
    path: PathBuf,
    input: BufReader<Input>,
    /// For each field of a line, its place in [`RAY_COLUMNS`].
    columns: Vec<usize>,
    /// The line in `text`, counting from 1.
    line: u64,
    text: Vec<u8>,
}

/// What is wrong with a line, and what would be right.
type Fault = (String, String);

impl CsvRays {
    /// Reads the header.
    pub(super) fn open(path: &Path, input: Input) -> Result<Self, Error> {
        let input = BufReader::with_capacity(1 << 20, input);
        let mut rays = Self { path: path.to_owned(), input, columns: Vec::new(), line: 0, text: Vec::new() };
        let found = rays.next_line()?;
        let text = rays.text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&rays.text);
        let names: Vec<String> = fields(text).map(|name| String::from_utf8_lossy(name).into_owned()).collect();
        let bad = |what: String| Error::bad(path.display().to_string(), "line 1", what, HEADER);
        if !found {
            return Err(bad("there is no header, the file is empty".to_owned()));
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        rays.columns = places(&names).map_err(bad)?;
        Ok(rays)
    }

    /// Reads the next line that is not blank; `false` at the end.
    fn next_line(&mut self) -> Result<bool, Error> {
        loop {
            self.text.clear();
            let mut limited = (&mut self.input).take(MAX_LINE as u64 + 1);
            let got = limited
                .read_until(b'\n', &mut self.text)
                .map_err(|source| Error::Io { path: self.path.clone(), source })?;
            if got == 0 {
                return Ok(false);
            }
            self.line += 1;
            if got > MAX_LINE {
                let what = format!("the line is longer than {MAX_LINE} bytes");
                return Err(Error::bad(self.path.display().to_string(), self.place(), what, "give a CSV file of rays"));
            }
            if !self.text.trim_ascii().is_empty() {
                return Ok(true);
            }
        }
    }

    fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// The row in the current line.
    fn parse(&self) -> Result<[f32; 8], Fault> {
        let mut values = DEFAULT_ROW;
        let mut count = 0;
        for (i, field) in fields(&self.text).enumerate() {
            count += 1;
            let Some(&column) = self.columns.get(i) else { continue };
            // Straight to f32: by way of f64 it would be rounded twice.
            values[column] = std::str::from_utf8(field).ok().and_then(number::parse).ok_or_else(|| {
                let field = String::from_utf8_lossy(field).chars().take(80).collect::<String>();
                (
                    format!("{} is {field:?}, not a number", RAY_COLUMNS[column]),
                    "give a decimal number, or a hexadecimal float that is an f32".to_owned(),
                )
            })?;
        }
        let names = self.columns.len();
        if count != names {
            return Err((format!("there are {count} values"), format!("give {names}, as many as the header names")));
        }
        Ok(values)
    }

    /// The error for the current line, once all malformed lines are counted.
    fn malformed(&mut self, (what, expected): Fault) -> Error {
        let place = self.place();
        let mut more = 0;
        while let Ok(true) = self.next_line() {
            more += usize::from(self.parse().is_err());
        }
        Error::Bad(Box::new(BadInput { file: self.path.display().to_string(), place, what, more, expected }))
    }
}

impl Source for CsvRays {
    fn fill(&mut self, rays: &mut Vec<Ray>, max: usize, faults: &mut Faults) -> Result<(), Error> {
        while rays.len() < max && self.next_line()? {
            match self.parse() {
                Ok(values) => rays.push(faults.admit(ray_of(values), || self.place())),
                Err(fault) => return Err(self.malformed(fault)),
            }
        }
        Ok(())
    }

    fn total(&self) -> Option<u64> {
        None
    }

    /// Always 0: a decimal is read as the nearest `f32`, and most decimals are none.
    fn rounded_values(&self) -> u64 {
        0
    }
}

/// The fields of a line, without the spaces and the quotes around them.
fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|&byte| byte == b',').map(|field| {
        let field = field.trim_ascii();
        field.strip_prefix(b"\"").and_then(|field| field.strip_suffix(b"\"")).unwrap_or(field)
    })
}
