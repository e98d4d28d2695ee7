use std::path::Path;

use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::{bits, dictionary, drain, npy_bytes, read_file, read_pipe};
use crate::tables::{BLOCK_ROWS, Format};
use crate::{Error, InvalidRays, RayReader, RayWriter};
use rayproof_scene::Ray;

/// The seed of every property here; proptest prints the input that fails.
const SEED: u64 = 0x52_61_79_73;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, rng_seed: RngSeed::Fixed(SEED), failure_persistence: None, ..ProptestConfig::default() }
}

fn formats() -> Vec<(&'static str, Format)> {
    let mut formats = vec![("npy", Format::Npy), ("csv", Format::Csv)];
    if cfg!(feature = "parquet") {
        formats.push(("parquet", Format::Parquet));
    }
    formats
}

/// A finite number: any bits, or one at an end of the range.
fn finite() -> impl Strategy<Value = f32> {
    let ends = [0.0, -0.0, f32::from_bits(1), -f32::from_bits(0x7f_ffff), f32::MIN_POSITIVE, f32::MAX, f32::MIN, 1e23];
    prop_oneof![
        3 => any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |x| x.is_finite()),
        1 => proptest::sample::select(ends.to_vec()),
    ]
}

prop_compose! {
    fn ray()(o in [finite(), finite(), finite()], d in [finite(), finite(), finite()], a in end(), b in end()) -> Ray {
        let direction = if Vec3::from(d) == Vec3::ZERO { Vec3::NEG_Y } else { Vec3::from(d) };
        // Not min and max, which may swap -0 and 0.
        let (t_min, t_max) = if a <= b { (a, b) } else { (b, a) };
        Ray { origin: Vec3::from(o), t_min, direction, t_max }
    }
}

fn end() -> impl Strategy<Value = f32> {
    prop_oneof![4 => finite(), 1 => Just(f32::INFINITY), 1 => Just(f32::NEG_INFINITY)]
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn what_is_written_reads_back_to_the_same_bits(
        rays in prop::collection::vec(ray(), 0..40), with_range: bool, announced: bool, cut in 0_usize..40
    ) {
        let directory = tempfile::tempdir().unwrap();
        for (ending, _) in formats() {
            let path = directory.path().join(format!("rays.{ending}"));
            let total = announced.then_some(rays.len() as u64);
            let mut writer = RayWriter::create(&path, None, with_range, total).unwrap();
            let (first, second) = rays.split_at(cut.min(rays.len()));
            writer.write(first).unwrap();
            writer.write(second).unwrap();
            writer.finish().unwrap();
            let back = read_file(&path).unwrap();
            let expected = rays.iter().map(|ray| if with_range { *ray } else { Ray::new(ray.origin, ray.direction) });
            let expected: Vec<_> = expected.map(|ray| bits(&ray)).collect();
            prop_assert_eq!(back.iter().map(bits).collect::<Vec<_>>(), expected, "{}", ending);
            let bytes = std::fs::read(&path).unwrap();
            prop_assert_eq!(read_pipe(&bytes, None).unwrap().len(), rays.len(), "{} by a pipe", ending);
        }
    }

    #[test]
    fn float64_rounds_as_the_language_does(values in prop::collection::vec(any::<f64>(), 8..=8)) {
        let bytes = npy_bytes(&dictionary("'<f8'", "(1, 8)"), values.iter().flat_map(|x| x.to_le_bytes()).collect());
        let input = Box::new(std::io::Cursor::new(bytes));
        let mut reader = RayReader::from_pipe(Path::new("-"), input, None, InvalidRays::Miss).unwrap();
        let ray = drain(&mut reader, 1).unwrap()[0];
        #[expect(clippy::cast_possible_truncation, reason = "what is expected")]
        let expected: Vec<u32> = values.iter().map(|&x| (x as f32).to_bits()).collect();
        let changed = values.iter().filter(|x| !x.is_nan() && f64::from(f32::from_bits(expected_bits(**x))) != **x).count();
        prop_assert_eq!(reader.rounding().values, changed as u64);
        if reader.invalid() == 0 {
            prop_assert_eq!(bits(&ray).to_vec(), expected);
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "what is expected")]
fn expected_bits(x: f64) -> u32 {
    (x as f32).to_bits()
}

#[test]
fn more_rays_than_a_block_keep_their_order() {
    let rays = super::some_rays(2 * BLOCK_ROWS + 3);
    let directory = tempfile::tempdir().unwrap();
    for (ending, _) in formats() {
        let path = directory.path().join(format!("rays.{ending}"));
        let mut writer = RayWriter::create(&path, None, false, None).unwrap();
        writer.write(&rays).unwrap();
        writer.finish().unwrap();
        for max in [BLOCK_ROWS - 1, BLOCK_ROWS, BLOCK_ROWS + 1, 3 * BLOCK_ROWS] {
            let mut reader = RayReader::open(&path, None, InvalidRays::Error).unwrap();
            assert!(drain(&mut reader, max).unwrap() == rays, "{ending} in batches of {max}");
        }
    }
}

/// Only bad input may be the answer to bytes, and never a panic.
fn harmless(result: Result<Vec<Ray>, Error>) {
    if let Err(error) = result {
        assert!(matches!(error, Error::Bad(_)), "{error}");
    }
}

proptest! {
    #![proptest_config(config(2000))]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), text in "[-0-9a-z_.,'\"{}()\\[\\]: \n]{0,200}") {
        for (_, format) in formats() {
            harmless(read_pipe(&bytes, Some(format)));
        }
        harmless(read_pipe(&npy_bytes(&text, bytes.clone()), None));
        harmless(read_pipe(&[b"ox,oy,oz,dx,dy,dz\n", text.as_bytes()].concat(), None));
        harmless(read_pipe(&[b"PAR1", &bytes[..], b"PAR1"].concat(), None));
    }

    #[test]
    fn damaged_files_never_panic(at in any::<prop::sample::Index>(), to in any::<u8>(), cut in any::<prop::sample::Index>()) {
        for (ending, bytes) in whole_files() {
            let mut damaged = bytes.clone();
            let at = at.index(damaged.len());
            damaged[at] = to;
            harmless(read_pipe(&damaged, None));
            let format = Format::of(Path::new(&format!("rays.{ending}"))).unwrap();
            harmless(read_pipe(&damaged[..cut.index(damaged.len())], Some(format)));
        }
    }
}

/// A small good file of every format.
fn whole_files() -> &'static [(&'static str, Vec<u8>)] {
    static FILES: std::sync::OnceLock<Vec<(&'static str, Vec<u8>)>> = std::sync::OnceLock::new();
    FILES.get_or_init(|| {
        let directory = tempfile::tempdir().unwrap();
        let write = |(ending, _): (&'static str, Format)| {
            let path = directory.path().join(format!("rays.{ending}"));
            let mut writer = RayWriter::create(&path, None, true, None).unwrap();
            writer.write(&super::some_rays(20)).unwrap();
            writer.finish().unwrap();
            (ending, std::fs::read(path).unwrap())
        };
        formats().into_iter().map(write).collect()
    })
}
