//! Tables of spheres: `.npy` and `.csv`.

use glam::Vec3;

use super::faults::{Faults, nearest};
use crate::Error;
use crate::tables::npy::Header;
use rayproof_scene::{Sphere, number};

pub(super) fn sphere([x, y, z, radius]: [f32; 4]) -> Sphere {
    Sphere { center: Vec3::new(x, y, z), radius }
}

/// A header and rows of `x,y,z,r`.
pub(super) fn csv(file: &str, bytes: &[u8]) -> Result<Vec<Sphere>, Error> {
    let expected = "give a header `x,y,z,r` and four numbers a line";
    let bad = |e: &csv::Error| {
        let place = e.position().map_or("the file".into(), |at| format!("line {}", at.line()));
        let what = match e.kind() {
            csv::ErrorKind::UnequalLengths { len, .. } => format!("there are {len} values"),
            csv::ErrorKind::Utf8 { err, .. } => err.to_string(),
            _ => e.to_string(),
        };
        Error::bad(file, place, what, expected)
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    let header = reader.headers().map_err(|e| bad(&e))?;
    if header != vec!["x", "y", "z", "r"] {
        let what = format!("the header is `{}`", header.iter().collect::<Vec<_>>().join(","));
        return Err(Error::bad(file, "line 1", what, expected));
    }
    let mut faults = Faults::new(file);
    let mut spheres = Vec::new();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|e| bad(&e))? {
        let line = record.position().map_or(0, csv::Position::line);
        let mut row = [0.0; 4];
        for (value, word) in row.iter_mut().zip(&record) {
            *value = number::parse(word).unwrap_or_else(|| {
                faults.add(format_args!("line {line}"), format_args!("`{word}` is not a number"), expected);
                0.0
            });
        }
        faults.sphere(format_args!("line {line}"), sphere(row));
        spheres.push(sphere(row));
    }
    faults.none()?;
    Ok(spheres)
}

const TABLE: &str = "give an array of shape (N, 4), dtype float32 or float64, little-endian, in C order";

/// An array `(N, 4)` of little-endian float32 or float64.
pub(super) fn npy(file: &str, bytes: &[u8]) -> Result<Vec<Sphere>, Error> {
    let bad = |what: String| Error::bad(file, "the header", what, TABLE);
    let mut rest = bytes;
    let header = Header::read(&mut rest).map_err(|e| bad(e.to_string()))?;
    let wide = match header.descr.trim_matches(['\'', '"']) {
        "<f4" => false,
        "<f8" => true,
        _ => return Err(bad(format!("the dtype is {}", header.descr))),
    };
    let Some(&[rows, 4]) = header.dimensions().as_deref() else {
        return Err(bad(format!("the shape is {}", header.shape)));
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
    let spheres: Vec<_> = if wide {
        let row = |row| bytemuck::pod_read_unaligned::<[[u8; 8]; 4]>(row).map(|x| nearest(f64::from_le_bytes(x)));
        rest.chunks_exact(32).map(row).map(sphere).collect()
    } else {
        let row = |row| bytemuck::pod_read_unaligned::<[[u8; 4]; 4]>(row).map(f32::from_le_bytes);
        rest.chunks_exact(16).map(row).map(sphere).collect()
    };
    let mut faults = Faults::new(file);
    for (i, &sphere) in spheres.iter().enumerate() {
        faults.sphere(format_args!("row {i} (counting from 0)"), sphere);
    }
    faults.none()?;
    Ok(spheres)
}
