//! Rays in and hits out, a batch at a time: `.npy`, `.csv` and, with the feature `parquet`, `.parquet`.
//!
//! Memory is bounded by the batch that the caller asks for, whatever the size of the file. Readers never guess: what
//! is not exactly a table of rays is an [`Error::Bad`](crate::Error::Bad). Writers never leave half a file under
//! the name they were given.

mod admission;
mod csv_rays;
mod format;
#[cfg(feature = "parquet")]
mod guarded;
mod hit_writer;
mod input;
mod kept;
pub(crate) mod npy;
mod npy_rays;
mod output;
#[cfg(feature = "parquet")]
mod parquet_claims;
#[cfg(feature = "parquet")]
mod parquet_rays;
#[cfg(feature = "parquet")]
mod parquet_table;
mod ray_reader;
mod ray_writer;
mod table;
#[cfg(test)]
mod tests;
#[cfg(feature = "parquet")]
mod thrift;

pub use format::Format;
pub use hit_writer::{HitKind, HitWriter};
pub use kept::{Kept, KeptColumns};
pub use ray_reader::RayReader;
pub use ray_writer::RayWriter;

use crate::quote::quoted;

/// The columns of a table of rays, in the order in which `.npy` holds them; the last two are optional.
const RAY_COLUMNS: [&str; 8] = ["ox", "oy", "oz", "dx", "dy", "dz", "t_min", "t_max"];

/// How many rows are converted at a time; a few MiB at most.
const BLOCK_ROWS: usize = 1 << 16;

/// For each named column its place in [`RAY_COLUMNS`], none for those that are not of a ray; or what is wrong: none of a ray's is
/// there twice, the first six are there, and of the last two both or neither. The case of letters does not matter. A name that is
/// nearly one of a ray's is wrong: a range that is passed over would change hits.
fn places(names: &[&str]) -> Result<Vec<Option<usize>>, String> {
    let letters = |name: &str| name.replace(|c: char| !c.is_ascii_alphanumeric(), "").to_ascii_lowercase();
    let mut places = Vec::new();
    for name in names {
        let place = RAY_COLUMNS.iter().position(|column| column.eq_ignore_ascii_case(name));
        let meant = RAY_COLUMNS.iter().find(|column| letters(column) == letters(name));
        match (place, meant) {
            (Some(_), Some(column)) if places.contains(&place) => {
                return Err(format!("the column {column} is there twice"));
            }
            (None, Some(column)) => {
                return Err(format!("{} is not the name of a column, and {column} may be meant", quoted(name)));
            }
            _ => places.push(place),
        }
    }
    let needed = if places.iter().flatten().any(|&place| place >= 6) { 8 } else { 6 };
    match (0..needed).find(|&place| !places.contains(&Some(place))) {
        Some(missing) => Err(format!("the column {} is missing", RAY_COLUMNS[missing])),
        None => Ok(places),
    }
}

/// The ray of a row in the order of [`RAY_COLUMNS`].
fn ray_of(v: [f32; 8]) -> rayproof_scene::Ray {
    rayproof_scene::Ray {
        origin: glam::Vec3::new(v[0], v[1], v[2]),
        t_min: v[6],
        direction: glam::Vec3::new(v[3], v[4], v[5]),
        t_max: v[7],
    }
}

/// The row of a ray in the order of [`RAY_COLUMNS`].
fn row_of(ray: &rayproof_scene::Ray) -> [f32; 8] {
    let (o, d) = (ray.origin, ray.direction);
    [o.x, o.y, o.z, d.x, d.y, d.z, ray.t_min, ray.t_max]
}

/// The row of a ray whose range is not given: `t_min = 0`, `t_max = inf`.
const DEFAULT_ROW: [f32; 8] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, f32::INFINITY];
