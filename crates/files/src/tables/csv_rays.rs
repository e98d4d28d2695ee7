//! The rays of a CSV file.
//!
//! Lines are split here and not by the csv crate: its line numbers are wrong after an empty line and for `\r\n`, and
//! a message that names the wrong line is worse than none. A table of numbers needs no more than commas.

use std::borrow::Cow;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::admission::Admission;
use super::input::Input;
use super::kept::{Kept, KeptColumns, Texts};
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
    /// The columns' names.
    names: Vec<String>,
    /// For each field of a line, its place in [`RAY_COLUMNS`], if it is of a ray.
    columns: Vec<Option<usize>>,
    /// The columns that are kept, in the order asked for.
    kept: Vec<usize>,
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

/// Which of a ray each column is, or what is wrong with the names.
fn columns(names: &[String]) -> Result<Vec<Option<usize>>, String> {
    match (names, [';', '\t'].into_iter().find(|&c| names[0].contains(c))) {
        ([line], Some(separator)) => Err(format!("the columns are apart by {separator:?}: {}", quoted(line))),
        _ => places(&names.iter().map(String::as_str).collect::<Vec<_>>()),
    }
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
            names: Vec::new(),
            columns: Vec::new(),
            kept: Vec::new(),
            place: Place::default(),
            text: Vec::new(),
            left: u64::MAX,
            marks: Vec::new(),
        };
        let (names, columns) = rays.header()?;
        (rays.names, rays.columns) = (names, columns);
        Ok(rays)
    }

    /// The columns' names, and which of a ray each is: in the first line that is no comment, or in a comment, as NumPy writes it.
    fn header(&mut self) -> Result<(Vec<String>, Vec<Option<usize>>), Error> {
        let path = self.path.display().to_string();
        let mut in_comment = None;
        while self.next_line()? {
            let text = self.text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&self.text).trim_ascii();
            let (text, is_comment) = text.strip_prefix(b"#").map_or((text, false), |text| (text, true));
            let names: Vec<String> =
                fields(text).map(|name| String::from_utf8_lossy(&name.text()).trim().to_owned()).collect();
            let what = match columns(&names) {
                Ok(columns) => return Ok((names, columns)),
                Err(what) => what,
            };
            let bad = Error::bad(path.clone(), self.line(), what, HEADER);
            let meant = names.iter().any(|name| RAY_COLUMNS.iter().any(|column| column.eq_ignore_ascii_case(name)));
            match is_comment {
                true if meant => in_comment = in_comment.or(Some(bad)),
                true => {}
                // A comment that was nearly a header tells more than the row after it.
                false => return Err(in_comment.unwrap_or(bad)),
            }
        }
        let empty = || Error::bad(path, "line 1", "there is no header, the file is empty".to_owned(), HEADER);
        Err(in_comment.unwrap_or_else(empty))
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
            let field = field.raw.trim_ascii();
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

    /// Adds the current line's values of the columns that are kept.
    fn keep_row(&self, kept: &mut Kept) {
        if self.kept.is_empty() {
            return;
        }
        let fields: Vec<Field<'_>> = fields(&self.text).collect();
        kept.text.iter_mut().zip(&self.kept).for_each(|(texts, &i)| texts.push(&fields[i].text()));
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
    fn columns(&self) -> Vec<&str> {
        self.names.iter().map(String::as_str).collect()
    }

    fn keep(&mut self, columns: &[usize]) -> Result<KeptColumns, Error> {
        self.kept = columns.to_vec();
        Ok(KeptColumns::text(columns.iter().map(|&i| self.names[i].clone()).collect()))
    }

    fn fill(
        &mut self,
        rays: &mut Vec<Ray>,
        kept: &mut Kept,
        max: usize,
        admission: &mut Admission,
    ) -> Result<(), Error> {
        kept.text.resize_with(self.kept.len(), Texts::default);
        while rays.len() < max && self.next_row()? {
            match self.parse() {
                Ok(values) => {
                    rays.push(admission.admit(values, || self.line()));
                    self.keep_row(kept);
                }
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

/// A value in a line.
struct Field<'a> {
    /// As it stands there, without the quotes around it.
    raw: &'a [u8],
    quoted: bool,
}

impl Field<'_> {
    /// What it says: a quote within quotes is written twice.
    fn text(&self) -> Cow<'_, [u8]> {
        if !(self.quoted && self.raw.contains(&b'"')) {
            return self.raw.into();
        }
        let mut text = Vec::with_capacity(self.raw.len());
        let mut bytes = self.raw.iter();
        while let Some(&byte) = bytes.next() {
            text.push(byte);
            if byte == b'"' {
                bytes.next();
            }
        }
        text.into()
    }
}

/// The fields of a line.
fn fields(line: &[u8]) -> impl Iterator<Item = Field<'_>> {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    let mut rest = Some(line.strip_suffix(b"\r").unwrap_or(line));
    std::iter::from_fn(move || {
        let here = rest?;
        let (field, after) = within_quotes(here).unwrap_or_else(|| {
            let end = memchr::memchr(b',', here).unwrap_or(here.len());
            (Field { raw: &here[..end], quoted: false }, &here[end..])
        });
        rest = after.strip_prefix(b",");
        Some(field)
    })
}

/// A field that begins and ends with a quote, and what follows it; `None` where it does not.
fn within_quotes(line: &[u8]) -> Option<(Field<'_>, &[u8])> {
    let inner = line.trim_ascii_start().strip_prefix(b"\"")?;
    let mut end = 0;
    loop {
        end += memchr::memchr(b'"', &inner[end..])?;
        if inner.get(end + 1) != Some(&b'"') {
            break;
        }
        end += 2;
    }
    let after = inner[end + 1..].trim_ascii_start();
    (after.is_empty() || after[0] == b',').then_some((Field { raw: &inner[..end], quoted: true }, after))
}
