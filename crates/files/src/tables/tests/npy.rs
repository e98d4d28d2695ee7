use std::fs;
use std::path::Path;

use glam::Vec3;

use super::{bad, bits, dictionary, drain, npy_bytes, npy_f4, read_file, read_pipe};
use crate::tables::npy;
use crate::{Error, Format, INVALID_RAY, InvalidRays, RayReader};
use rayproof_scene::Ray;

/// Two rays without a range.
const TWELVE: [f32; 12] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0];

#[test]
fn six_columns_get_the_default_range() {
    let rays = read_pipe(&npy_f4(&dictionary("'<f4'", "(2, 6)"), &TWELVE), None).unwrap();
    assert_eq!(rays[1], Ray::new(Vec3::new(6.0, 7.0, 8.0), Vec3::new(9.0, 10.0, 11.0)));
    assert_eq!(rays.len(), 2);
}

#[test]
fn no_rays_are_no_error() {
    for shape in ["(0, 6)", "(0, 8)"] {
        assert_eq!(read_pipe(&npy_f4(&dictionary("'<f4'", shape), &[]), None).unwrap(), []);
    }
}

#[test]
fn headers_that_are_not_a_table_of_rays_say_what_they_are() {
    let d = dictionary;
    let fortran = "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 6), }".to_owned();
    let unordered = "{'descr': '<f4', 'fortran_order': 1, 'shape': (2, 6), }".to_owned();
    let cases = [
        (d("'>f4'", "(2, 6)"), "the dtype is '>f4', which is big-endian"),
        (d("'>f8'", "(2, 6)"), "the dtype is '>f8', which is big-endian"),
        (d("'<f2'", "(2, 6)"), "the dtype is '<f2'"),
        (d("'<i4'", "(2, 6)"), "the dtype is '<i4'"),
        (d("'|O'", "(2, 6)"), "the dtype is '|O'"),
        (d("[('ox', '<f4'), ('oy', '<f4')]", "(2,)"), "the dtype is [('ox', '<f4'), ('oy', '<f4')]"),
        (d("'<f4'", "(2, 7)"), "the shape is (2, 7)"),
        (d("'<f4'", "(12,)"), "the shape is (12,)"),
        (d("'<f4'", "()"), "the shape is ()"),
        (d("'<f4'", "(1, 2, 6)"), "the shape is (1, 2, 6)"),
        (d("'<f4'", "(6, 2)"), "the shape is (6, 2)"),
        (d("'<f4'", "(-2, 6)"), "the shape is (-2, 6)"),
        (d("'<f4'", "(2.0, 6)"), "the shape is (2.0, 6)"),
        (d("'<f4'", "(1+1, 6)"), "the shape is (1+1, 6)"),
        (d("'<f4'", "(99999999999999999999, 6)"), "the shape is (99999999999999999999, 6)"),
        (d("'<f4'", "(9223372036854775808, 6)"), "the shape is (9223372036854775808, 6), more than a file can hold"),
        (fortran, "the array is in Fortran order"),
        (unordered, "the header is not a dictionary of an array: "),
        ("{'descr': '<f4', 'shape': (2, 6), }".to_owned(), "the header is not a dictionary of an array: "),
        (d("'<f4'", "(2, 6), 'shape': (2, 6)"), "the header is not a dictionary of an array: "),
        ("[".repeat(5000), "the header is not a dictionary of an array: "),
        ("{".repeat(10_000), "the header has 10001 bytes, more than 10000"),
    ];
    for (header, what) in cases {
        let bad = bad(read_pipe(&npy_f4(&header, &TWELVE), Some(Format::Npy)));
        let matches = if what.ends_with(": ") { bad.what.starts_with(what) } else { bad.what == what };
        assert!(matches, "{header}: {}", bad.what);
        assert_eq!((bad.file.as_str(), bad.place.as_str(), bad.more), ("-", "header", 0));
        assert!(bad.expected.starts_with("give shape (N, 6) or (N, 8), little-endian float32, C order"));
    }
}

#[test]
fn other_files_are_not_npy() {
    let version = b"\x93NUMPY\x09\x00\x00\x00".to_vec();
    for (bytes, what) in [
        (b"ox,oy,oz,dx,dy,dz\n".to_vec(), "it does not start with the .npy magic number"),
        (version, "the .npy version 9.0 is not known"),
        (Vec::new(), "the file ends within its header"),
    ] {
        assert_eq!(bad(read_pipe(&bytes, Some(Format::Npy))).what, what);
    }
}

#[test]
fn the_newer_header_versions_are_read() {
    let text = dictionary("\"<f4\"", "(2,6)");
    for version in [2, 3] {
        let length = u32::try_from(text.len()).unwrap().to_le_bytes();
        let start = [b"\x93NUMPY", &[version, 0][..], &length, text.as_bytes()].concat();
        let data: Vec<u8> = TWELVE.iter().flat_map(|x| x.to_le_bytes()).collect();
        assert_eq!(read_pipe(&[start, data].concat(), None).unwrap().len(), 2);
    }
}

#[test]
fn a_file_cut_anywhere_is_bad() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.npy");
    let whole = npy_f4(&dictionary("'<f4'", "(2, 6)"), &TWELVE);
    for cut in 0..whole.len() {
        fs::write(&path, &whole[..cut]).unwrap();
        let file = bad(read_file(&path));
        let pipe = bad(read_pipe(&whole[..cut], Some(Format::Npy)));
        assert_eq!((&file.place, &file.what), (&pipe.place, &pipe.what), "cut at {cut}");
        if let Some(data) = cut.checked_sub(whole.len() - 48) {
            let there = format!("there are {data} bytes, {} whole rows", data / 24);
            assert_eq!(file.what, format!("the header promises 2 rows of 24 bytes, 48 bytes of data; {there}"));
        }
    }
    fs::write(&path, &whole).unwrap();
    assert_eq!(read_file(&path).unwrap().len(), 2, "the whole file is good");
}

#[test]
fn bytes_after_the_last_row_are_bad() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.npy");
    for rows in [0, 2] {
        let mut bytes = npy_f4(&dictionary("'<f4'", &format!("({rows}, 6)")), &TWELVE[..rows * 6]);
        bytes.push(0);
        fs::write(&path, &bytes).unwrap();
        let (file, pipe) = (bad(read_file(&path)), bad(read_pipe(&bytes, None)));
        let data = rows * 24;
        assert!(file.what.ends_with(&format!("there are {} bytes, {rows} whole rows", data + 1)), "{}", file.what);
        assert!(pipe.what.ends_with(&format!("there are more than {data} bytes, {rows} whole rows")), "{}", pipe.what);
    }
}

#[test]
fn float64_is_rounded_to_the_nearest_and_counted() {
    // Halfway between 1 and the next f32, and one f64 above that; only these and the overflow are not f32 already.
    let (half, above) = (1.0 + 2.0_f64.powi(-24), 1.0 + 2.0_f64.powi(-24) + 2.0_f64.powi(-52));
    let values = [half, above, 0.5, 1.0, 0.0, -0.0, -1e300, f64::INFINITY];
    let data = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes = npy_bytes(&dictionary("'<f8'", "(1, 8)"), data);
    let input = Box::new(std::io::Cursor::new(bytes));
    let mut reader = RayReader::from_pipe(Path::new("-"), input, None, InvalidRays::Error).unwrap();
    let rays = drain(&mut reader, 10).unwrap();
    let up = 1.0_f32.next_up();
    let expected = Ray {
        origin: Vec3::new(1.0, up, 0.5),
        t_min: f32::NEG_INFINITY,
        direction: Vec3::new(1.0, 0.0, -0.0),
        t_max: f32::INFINITY,
    };
    assert_eq!(bits(&rays[0]), bits(&expected));
    assert_eq!(reader.rounding().values, 3);
}

#[test]
fn a_float64_nan_is_no_rounded_value() {
    let data = [f64::NAN, 1.0, 1.0, 1.0, 1.0, 0.1].iter().flat_map(|x| x.to_le_bytes()).collect();
    let input = Box::new(std::io::Cursor::new(npy_bytes(&dictionary("'<f8'", "(1, 6)"), data)));
    let mut reader = RayReader::from_pipe(Path::new("-"), input, None, InvalidRays::Miss).unwrap();
    assert_eq!(drain(&mut reader, 10).unwrap(), [INVALID_RAY]);
    assert_eq!((reader.invalid(), reader.rounding().values), (1, 1));
}

#[test]
fn float64_beyond_float32_is_bad_in_origin_and_direction() {
    for (place, what) in [(0, "the origin is not finite"), (4, "the direction is not finite")] {
        let mut values = [1.0; 6];
        values[place] = 3.5e38;
        let data = values.iter().flat_map(|x: &f64| x.to_le_bytes()).collect();
        let bad = bad(read_pipe(&npy_bytes(&dictionary("'<f8'", "(1, 6)"), data), None));
        assert_eq!(bad.place, "row 0 (counting from 0, rounded to float32)");
        assert!(bad.what.starts_with(what), "{}", bad.what);
    }
}

#[test]
fn the_first_bad_ray_is_named_and_all_are_counted() {
    let mut values = vec![1.0_f32; 8 * 20];
    values[8 * 7 + 1] = f32::NAN;
    values[8 * 8 + 5] = f32::INFINITY;
    values[8 * 13 + 3..8 * 13 + 6].fill(0.0);
    values[8 * 19 + 6] = 2.0;
    let bytes = npy_f4(&dictionary("'<f4'", "(20, 8)"), &values);
    let first = bad(read_pipe(&bytes, None));
    assert_eq!((first.place.as_str(), first.more), ("row 7 (counting from 0)", 3));
    assert_eq!(
        first.to_string(),
        "-: row 7 (counting from 0): the origin is not finite: ox,oy,oz,dx,dy,dz,t_min,t_max = \
         [1.0, NaN, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0] (the first of 4); give three finite numbers"
    );

    let input = Box::new(std::io::Cursor::new(bytes));
    let mut reader = RayReader::from_pipe(Path::new("-"), input, None, InvalidRays::Miss).unwrap();
    let rays = drain(&mut reader, 6).unwrap();
    let missing: Vec<usize> = (0..20).filter(|&i| rays[i] == INVALID_RAY).collect();
    assert_eq!((missing, reader.invalid(), reader.total()), (vec![7, 8, 13, 19], 4, Some(20)));
    assert!(rays.iter().all(|ray| *ray == INVALID_RAY || ray.fault().is_none()));
}

#[test]
fn a_file_that_is_not_there_cannot_be_opened() {
    let directory = tempfile::tempdir().unwrap();
    for path in [directory.path().join("none.npy"), directory.path().join("folder.npy")] {
        if path.ends_with("folder.npy") {
            fs::create_dir(&path).unwrap();
        }
        assert!(matches!(RayReader::open(&path, None, InvalidRays::Error), Err(Error::Open { .. })));
    }
    let unknown = bad(RayReader::open(Path::new("rays.txt"), None, InvalidRays::Error));
    assert_eq!(unknown.what, "the ending .txt is not known");
    assert_eq!(bad(RayReader::open(Path::new("rays"), None, InvalidRays::Error)).what, "it has no ending");
}

#[test]
fn a_header_is_as_long_for_any_number_of_rows() {
    for padding in 0..64 {
        let descr = format!("'<f4{}'", "x".repeat(padding));
        let header = |rows| npy::header(&descr, |rows| format!("({rows},)"), rows);
        for rows in [0, 9, 10, 123_456_789, u64::MAX] {
            let bytes = header(rows);
            assert_eq!((bytes.len() % 64, bytes.len()), (0, header(0).len()), "{rows} rows");
            let read = npy::Header::read(&mut &bytes[..]).unwrap();
            assert_eq!((read.descr.as_str(), read.dimensions()), (descr.as_str(), Some(vec![rows])));
            assert_eq!(read.bytes, bytes.len() as u64);
        }
    }
}
