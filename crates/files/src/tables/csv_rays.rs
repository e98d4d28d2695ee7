//! The rays of a CSV file.
//!
//! Lines are split here and not by the csv crate: its line numbers are wrong after an empty line and for `\r\n`, and
//! a message that names the wrong line is worse than none. A table of numbers needs no more than commas.

use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::admission::Admission;
use super::input::Input;
use super::ray_reader::Source;
use super::{DEFAULT_ROW, RAY_COLUMNS, places};
use crate::decimal::Number;
use crate::quote::quoted;
use crate::{BadInput, Error};
use rayproof_scene::Ray;

/// The longest line that is read, in bytes: what is longer is no table of rays.
const MAX_LINE: usize = 1 << 16;

/// How many rows lie between two places that are remembered when rows are counted.
const EVERY: u64 = 1 << 16;

/// What would be right, in a message about the header.
const HEADER: &str = "give a first line with ox,oy,oz,dx,dy,dz or ox,oy,oz,dx,dy,dz,t_min,t_max";

/// The rays of a CSV file, as a stream.
pub(super) struct CsvRays {
    path: PathBuf,
    input: BufReader<Input>,
    /// For each field of a line, its place in [`RAY_COLUMNS`], if it is of a ray.
    columns: Vec<Option<usize>>,
    /// What was read last.
    place: Place,
    text: Vec<u8>,
    /// How many rows are left to hand on.
    left: u64,
    /// Where the rows 0, [`EVERY`], 2 [`EVERY`], .. may be read from; empty where rows were not counted.
    marks: Vec<Place>,
}

/// How far a file was read: so many lines, and so many bytes.
#[derive(Clone, Copy, Default)]
struct Place {
    line: u64,
    bytes: u64,
}

/// What is wrong with a line, and what would be right.
type Fault = (String, String);

impl CsvRays {
    /// Reads the header.
    pub(super) fn open(path: &Path, input: Input) -> Result<Self, Error> {
        let input = BufReader::with_capacity(1 << 20, input);
        let mut rays = Self {
            path: path.to_owned(),
            input,
            columns: Vec::new(),
            place: Place::default(),
            text: Vec::new(),
            left: u64::MAX,
            marks: Vec::new(),
        };
        let found = rays.next_line()?;
        let text = rays.text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&rays.text);
        // NumPy writes a header as a comment.
        let text = text.strip_prefix(b"#").unwrap_or(text);
        let names: Vec<String> = fields(text).map(|name| String::from_utf8_lossy(name).into_owned()).collect();
        let bad = |what: String| Error::bad(path.display().to_string(), "line 1", what, HEADER);
        if !found {
            return Err(bad("there is no header, the file is empty".to_owned()));
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        if let ([line], Some(separator)) = (&names[..], [';', '\t'].into_iter().find(|&c| names[0].contains(c))) {
            let what = format!("the columns are apart by {separator:?}: {}", quoted(line));
            return Err(bad(what));
        }
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
            self.place.line += 1;
            self.place.bytes += got as u64;
            if got > MAX_LINE {
                let what = format!("the line is longer than {MAX_LINE} bytes");
                return Err(Error::bad(self.path.display().to_string(), self.line(), what, "give a CSV file of rays"));
            }
            let text = self.text.trim_ascii();
            // Before the header is read there are no columns, and a `#` may begin it.
            let is_comment = !self.columns.is_empty() && text.starts_with(b"#");
            if !(text.is_empty() || is_comment) {
                return Ok(true);
            }
        }
    }

    /// The next line that is handed on; `false` at the end.
    fn next_row(&mut self) -> Result<bool, Error> {
        let found = self.left > 0 && self.next_line()?;
        self.left -= u64::from(found);
        Ok(found)
    }

    fn go_to(&mut self, place: Place) -> Result<(), Error> {
        let sought = self.input.seek(SeekFrom::Start(place.bytes));
        sought.map_err(|source| Error::Io { path: self.path.clone(), source })?;
        self.place = place;
        Ok(())
    }

    fn line(&self) -> String {
        format!("line {}", self.place.line)
    }

    /// The row in the current line.
    fn parse(&self) -> Result<[Number; 8], Fault> {
        let mut values = DEFAULT_ROW.map(Number::from);
        let mut count = 0;
        for (i, field) in fields(&self.text).enumerate() {
            count += 1;
            let Some(&Some(column)) = self.columns.get(i) else { continue };
            values[column] = Number::parse_any(field).ok_or_else(|| {
                (
                    format!("{} is {}, not a number", RAY_COLUMNS[column], quoted(field)),
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
        let place = self.line();
        let mut more = 0;
        while let Ok(true) = self.next_row() {
            more += usize::from(self.parse().is_err());
        }
        Error::Bad(Box::new(BadInput { file: self.path.display().to_string(), place, what, more, expected }))
    }
}

impl Source for CsvRays {
    fn fill(&mut self, rays: &mut Vec<Ray>, max: usize, admission: &mut Admission) -> Result<(), Error> {
        while rays.len() < max && self.next_row()? {
            match self.parse() {
                Ok(values) => rays.push(admission.admit(values, || self.line())),
                Err(fault) => return Err(self.malformed(fault)),
            }
        }
        Ok(())
    }

    fn total(&self) -> Option<u64> {
        None
    }

    fn count(&mut self) -> Result<Option<u64>, Error> {
        if let Input::Pipe(_) = self.input.get_ref() {
            return Ok(None);
        }
        let (start, mut rows) = (self.place, 0);
        self.marks.clear();
        loop {
            if rows % EVERY == 0 {
                self.marks.push(self.place);
            }
            if !self.next_line()? {
                break;
            }
            rows += 1;
        }
        self.go_to(start)?;
        Ok(Some(rows))
    }

    fn select(&mut self, rows: Range<u64>) -> Result<(), Error> {
        let mut before = rows.start;
        let mark = usize::try_from(before / EVERY).ok().and_then(|i| self.marks.get(i));
        if let Some(&mark) = mark {
            before %= EVERY;
            self.go_to(mark)?;
        }
        while before > 0 && self.next_line()? {
            before -= 1;
        }
        self.left = rows.end - rows.start;
        Ok(())
    }
}

/// The fields of a line, without the spaces and the quotes around them.
fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|&byte| byte == b',').map(|field| {
        let field = field.trim_ascii();
        field.strip_prefix(b"\"").and_then(|field| field.strip_suffix(b"\"")).unwrap_or(field)
    })
}
