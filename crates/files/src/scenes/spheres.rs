//! Tables of spheres: `.npy` and `.csv`.

use super::lines::without_mark;
use super::reading::Reading;
use crate::Error;
use crate::decimal::Number;
use crate::quote::quoted;
use crate::tables::npy::Header;
use rayproof_scene::Sphere;

/// The places of x, y, z and r among the names; none where one is missing or there twice.
fn columns<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Option<[usize; 4]> {
    let place = |known: &[&str]| {
        let is = |name: &str| known.iter().any(|known| known.eq_ignore_ascii_case(name));
        let mut found = names.clone().enumerate().filter(|(_, name)| is(name)).map(|(i, _)| i);
        found.next().filter(|_| found.next().is_none())
    };
    Some([place(&["x"])?, place(&["y"])?, place(&["z"])?, place(&["r", "radius"])?])
}

/// How many lines stand before the header, and what is from it on. It is in the first line that is no comment, or in a comment,
/// as NumPy writes it.
fn from_header(bytes: &[u8]) -> (u64, &[u8]) {
    let (mut before, mut rest) = (0, bytes);
    loop {
        let end = memchr::memchr(b'\n', rest).map_or(rest.len(), |at| at + 1);
        let line = rest[..end].trim_ascii_start();
        match line.strip_prefix(b"#").map(std::str::from_utf8) {
            Some(Ok(text)) if columns(text.split(',').map(str::trim)).is_some() => {
                return (before, &rest[rest.len() - rest.trim_ascii_start().len() + 1..]);
            }
            Some(_) => {}
            None if line.is_empty() && end > 0 => {}
            None => return (before, rest),
        }
        (before, rest) = (before + 1, &rest[end..]);
    }
}

/// A header and rows of `x,y,z,r`, in any order, among other columns; `radius` is `r`.
pub(super) fn csv(file: &str, bytes: &[u8], mut reading: Reading<'_>) -> Result<Vec<Sphere>, Error> {
    let expected = "give a header `x,y,z,r` and four numbers a line";
    let (before, bytes) = from_header(without_mark(bytes));
    let bad = |e: &csv::Error| {
        let place = e.position().map_or("the file".into(), |at| format!("line {}", before + at.line()));
        let what = match e.kind() {
            csv::ErrorKind::UnequalLengths { len, .. } => format!("there are {len} values"),
            csv::ErrorKind::Utf8 { err, .. } => err.to_string(),
            _ => e.to_string(),
        };
        Error::bad(file, place, what, expected)
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(bytes);
    let header = reader.headers().map_err(|e| bad(&e))?;
    let Some(columns) = columns(header.iter()) else {
        let what = format!("the header is {}", quoted(header.iter().collect::<Vec<_>>().join(",")));
        return Err(Error::bad(file, format!("line {}", before + 1), what, expected));
    };
    let mut spheres = Vec::new();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|e| bad(&e))? {
        let line = record.position().map_or(0, csv::Position::line) + before;
        let mut row = [Number::default(); 4];
        for (value, column) in row.iter_mut().zip(columns) {
            let word = record.get(column).unwrap_or_default();
            *value = Number::parse_any(word.as_bytes()).unwrap_or_else(|| {
                reading.fault(format_args!("line {line}"), format_args!("{} is not a number", quoted(word)), expected);
                Number::default()
            });
        }
        spheres.push(reading.sphere(format_args!("line {line}"), row));
    }
    reading.end()?;
    Ok(spheres)
}

const TABLE: &str = "give an array of shape (N, 4), dtype float32 or float64, little-endian, in C order";

/// An array `(N, 4)` of little-endian float32 or float64.
pub(super) fn npy(file: &str, bytes: &[u8], mut reading: Reading<'_>) -> Result<Vec<Sphere>, Error> {
    let bad = |what: String| Error::bad(file, "the header", what, TABLE);
    let mut rest = bytes;
    let header = Header::read(&mut rest).map_err(|e| bad(e.to_string()))?;
    let wide = match header.descr.trim_matches(['\'', '"']) {
        "<f4" => false,
        "<f8" => true,
        _ => return Err(bad(header.wrong_descr())),
    };
    let Some(&[rows, 4]) = header.dimensions().as_deref() else {
        return Err(bad(header.wrong_shape()));
    };
    if header.fortran_order {
        return Err(bad("the array is in Fortran order".into()));
    }
    let width = if wide { 32 } else { 16 };
    if rows.checked_mul(width) != Some(rest.len() as u64) {
        let what = format!("{rows} rows of {width} bytes are announced and {} bytes follow", rest.len());
        return Err(Error::bad(
            file,
            format!("row {} (counting from 0)", rest.len() as u64 / width),
            what,
            "give the whole file",
        ));
    }
    let rows: Box<dyn Iterator<Item = [Number; 4]>> = if wide {
        let row = |row| bytemuck::pod_read_unaligned::<[[u8; 8]; 4]>(row).map(|x| f64::from_le_bytes(x).into());
        Box::new(rest.chunks_exact(32).map(row))
    } else {
        let row = |row| bytemuck::pod_read_unaligned::<[[u8; 4]; 4]>(row).map(|x| f32::from_le_bytes(x).into());
        Box::new(rest.chunks_exact(16).map(row))
    };
    let spheres =
        rows.enumerate().map(|(i, row)| reading.sphere(format_args!("row {i} (counting from 0)"), row)).collect();
    reading.end()?;
    Ok(spheres)
}
