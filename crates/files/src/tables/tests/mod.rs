#![expect(clippy::unwrap_used, reason = "a test")]

mod csv;
mod kept;
mod npy;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "parquet")]
mod parquet_claims;
mod pipe;
mod round_trip;
mod select;
mod write;

use std::io::Cursor;
use std::path::Path;

use glam::Vec3;

use super::{Format, RayReader};
use crate::InvalidRays;
use crate::{BadInput, Error};
use rayproof_scene::Ray;

/// Every ray of a reader, in batches of `max`.
fn drain(reader: &mut RayReader, max: usize) -> Result<Vec<Ray>, Error> {
    let (mut all, mut batch) = (Vec::new(), Vec::new());
    while reader.next_batch(&mut batch, max)? > 0 {
        assert!(batch.len() <= max);
        all.extend_from_slice(&batch);
    }
    assert_eq!(reader.next_batch(&mut batch, max)?, 0, "the end comes twice");
    Ok(all)
}

/// Every ray of a file.
fn read_file(path: &Path) -> Result<Vec<Ray>, Error> {
    drain(&mut RayReader::open(path, None, InvalidRays::Error)?, 3)
}

/// Every ray of these bytes, as from a pipe.
fn read_pipe(bytes: &[u8], format: Option<Format>) -> Result<Vec<Ray>, Error> {
    let input = Box::new(Cursor::new(bytes.to_vec()));
    drain(&mut RayReader::from_pipe(Path::new("-"), input, format, InvalidRays::Error)?, 3)
}

/// What is bad; anything else fails the test.
fn bad<T>(result: Result<T, Error>) -> BadInput {
    match result {
        Err(Error::Bad(bad)) => *bad,
        Err(other) => panic!("not bad input, but {other}"),
        Ok(_) => panic!("accepted"),
    }
}

/// The bits of a ray, to compare.
fn bits(ray: &Ray) -> [u32; 8] {
    super::row_of(ray).map(f32::to_bits)
}

/// `count` rays, all different.
#[expect(clippy::cast_precision_loss, reason = "small numbers")]
fn some_rays(count: usize) -> Vec<Ray> {
    (0..count).map(|i| Ray::new(Vec3::new(i as f32, 0.1, -2.5), Vec3::new(1.0, i as f32, 0.3))).collect()
}

/// An `.npy` file with this dictionary and these values.
fn npy_f4(dictionary: &str, values: &[f32]) -> Vec<u8> {
    npy_bytes(dictionary, values.iter().flat_map(|x| x.to_le_bytes()).collect())
}

/// An `.npy` file with this dictionary and this data.
fn npy_bytes(dictionary: &str, data: Vec<u8>) -> Vec<u8> {
    let length = u16::try_from(dictionary.len() + 1).unwrap().to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], dictionary.as_bytes(), b"\n", &data].concat()
}

/// The dictionary of a C-ordered array.
fn dictionary(descr: &str, shape: &str) -> String {
    format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}")
}
