use std::io::Cursor;
use std::ops::Range;
use std::path::Path;

use super::{bad, dictionary, drain, npy_f4, some_rays};
use crate::{Error, InvalidRays, RayReader, RayWriter};
use rayproof_scene::Ray;

const ENDINGS: &[&str] = if cfg!(feature = "parquet") { &["npy", "csv", "parquet"] } else { &["npy", "csv"] };

fn write(path: &Path, rays: &[Ray]) {
    let mut writer = RayWriter::create(path, None, true, None).unwrap();
    writer.write(rays).unwrap();
    writer.finish().unwrap();
}

fn selected(mut reader: RayReader, rows: Range<u64>) -> Result<Vec<Ray>, Error> {
    let count = rows.end - rows.start;
    reader.select(rows)?;
    assert_eq!(reader.total(), Some(count));
    drain(&mut reader, 4)
}

fn open(path: &Path) -> RayReader {
    RayReader::open(path, None, InvalidRays::Error).unwrap()
}

fn pipe(bytes: &[u8]) -> RayReader {
    RayReader::from_pipe(Path::new("-"), Box::new(Cursor::new(bytes.to_vec())), None, InvalidRays::Error).unwrap()
}

#[test]
fn a_selection_is_that_part_of_the_whole_from_files_and_pipes() {
    let (directory, rays) = (tempfile::tempdir().unwrap(), some_rays(13));
    for ending in ENDINGS {
        let path = directory.path().join(format!("rays.{ending}"));
        write(&path, &rays);
        let bytes = std::fs::read(&path).unwrap();
        for (start, end) in (0..=13).flat_map(|end| (0..=end).map(move |start| (start, end))) {
            let want = &rays[start..end];
            let rows = start as u64..end as u64;
            assert_eq!(selected(open(&path), rows.clone()).unwrap(), want, "{ending} {rows:?}");
            assert_eq!(selected(pipe(&bytes), rows.clone()).unwrap(), want, "{ending} {rows:?} by a pipe");
            let mut counted = open(&path);
            assert_eq!(counted.count().unwrap(), Some(13));
            assert_eq!(selected(counted, rows.clone()).unwrap(), want, "{ending} {rows:?} once counted");
        }
    }
}

#[test]
fn rows_far_into_a_file_are_found() {
    // Beyond a mark of the CSV file.
    let (directory, rays) = (tempfile::tempdir().unwrap(), some_rays(140_000));
    for ending in ENDINGS {
        let path = directory.path().join(format!("rays.{ending}"));
        write(&path, &rays);
        for start in [65_535, 65_536, 131_071, 131_072, 139_990] {
            let mut reader = open(&path);
            assert_eq!(reader.count().unwrap(), Some(140_000));
            let end = start + 10;
            assert!(selected(reader, start as u64..end as u64).unwrap() == rays[start..end], "{ending} {start}");
        }
    }
}

#[test]
fn a_bad_ray_outside_of_the_selection_is_none_of_its_faults() {
    let (directory, mut rays) = (tempfile::tempdir().unwrap(), some_rays(12));
    for i in [1, 5, 7, 10] {
        rays[i].origin.y = f32::NAN;
    }
    for (ending, place) in
        [("npy", "row 5 (counting from 0)"), ("csv", "line 7"), ("parquet", "row 5 (counting from 0)")]
    {
        if !ENDINGS.contains(&ending) {
            continue;
        }
        let path = directory.path().join(format!("rays.{ending}"));
        write(&path, &rays);
        assert_eq!(selected(open(&path), 2..5).unwrap(), rays[2..5]);
        let first = bad(selected(open(&path), 2..9));
        assert_eq!((first.place.as_str(), first.more), (place, 1), "{ending}");
        let mut reader = RayReader::open(&path, None, InvalidRays::Miss).unwrap();
        reader.select(4..8).unwrap();
        assert_eq!((drain(&mut reader, 3).unwrap().len(), reader.invalid()), (4, 2), "{ending}");
    }
}

#[test]
fn lines_outside_of_the_selection_are_counted_and_not_parsed() {
    let text = "ox,oy,oz,dx,dy,dz\n\n0,0,0,1,1,x\n \r\n1,0,0,1,1,1\r\n\n2,0,0,1,1,1\n3,0,0,1,1\n4,0,0,y,1,1";
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.csv");
    std::fs::write(&path, text).unwrap();
    let counted = || {
        let mut reader = open(&path);
        assert_eq!(reader.count().unwrap(), Some(5));
        reader
    };
    let origins = selected(counted(), 1..3).unwrap().iter().map(|ray| ray.origin.x).collect::<Vec<_>>();
    assert_eq!(origins, [1.0, 2.0]);
    let first = bad(selected(counted(), 2..4));
    assert_eq!((first.place.as_str(), first.what.as_str(), first.more), ("line 8", "there are 5 values", 0));
    assert_eq!(bad(selected(counted(), 3..5)).more, 1);
    assert_eq!(pipe(text.as_bytes()).count().unwrap(), None, "a pipe comes but once");
}

#[test]
fn a_pipe_that_ends_before_its_selection_is_bad() {
    let whole = npy_f4(&dictionary("'<f4'", "(3, 6)"), &[1.0; 18]);
    for (cut, end) in [(13, "there are 59 bytes, 2 whole rows"), (50, "there are 22 bytes, 0 whole rows")] {
        let cut = bad(selected(pipe(&whole[..whole.len() - cut]), 2..3));
        assert!(cut.what.ends_with(end), "{}", cut.what);
    }
}

#[test]
#[should_panic(expected = "rows 2..14 of 13")]
fn more_rows_than_there_are_cannot_be_selected() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.npy");
    write(&path, &some_rays(13));
    let _ = open(&path).select(2..14);
}
