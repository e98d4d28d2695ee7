//! Files that claim more than they hold: refused before anything is reserved for it.

use std::fs::{self, File};
use std::path::Path;

use parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader, ParquetMetaDataWriter};

use super::{bad, read_file, read_pipe, some_rays};
use crate::{Format, RayWriter};

/// 2^31 - 1, as the format writes it.
const HUGE: [u8; 5] = [0xfe, 0xff, 0xff, 0xff, 0x0f];

/// A good file, and what its footer says.
fn good(path: &Path) -> (Vec<u8>, ParquetMetaData) {
    let mut writer = RayWriter::create(path, None, false, None).unwrap();
    writer.write(&some_rays(50)).unwrap();
    writer.finish().unwrap();
    let metadata = ParquetMetaDataReader::new().parse_and_finish(&File::open(path).unwrap()).unwrap();
    (fs::read(path).unwrap(), metadata)
}

/// The data of a file, its last column's first page changed by `edit`, and a footer that says by how much that grew, and `more`.
fn changed((bytes, metadata): &(Vec<u8>, ParquetMetaData), edit: impl Fn(&mut Vec<u8>), more: i64) -> Vec<u8> {
    let column = metadata.row_group(0).columns().last().unwrap().clone();
    let (start, length) = column.byte_range();
    let (start, end) = (usize::try_from(start).unwrap(), usize::try_from(start + length).unwrap());
    let mut page = bytes[start..end].to_vec();
    edit(&mut page);
    let length = i64::try_from(page.len()).unwrap() + more;
    let column = column.into_builder().set_total_compressed_size(length).build().unwrap();
    let mut columns = metadata.row_group(0).columns().to_vec();
    *columns.last_mut().unwrap() = column;
    let group = metadata.row_group(0).clone().into_builder().set_column_metadata(columns).build().unwrap();
    let metadata = metadata.clone().into_builder().set_row_groups(vec![group]).build();
    let mut file = [&bytes[..start], &page].concat();
    let mut footer = Vec::new();
    ParquetMetaDataWriter::new(&mut footer, &metadata).finish().unwrap();
    file.extend(footer);
    file
}

/// Puts `HUGE` in the place of the number that starts at `at`.
fn claim(page: &mut Vec<u8>, at: usize) {
    let length = 1 + page[at..].iter().take_while(|&&byte| byte > 127).count();
    page.splice(at..at + length, HUGE);
}

#[test]
fn pages_that_claim_more_than_they_can_hold_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    let good = good(&path);
    let case = |edit: &dyn Fn(&mut Vec<u8>), more: i64| {
        fs::write(&path, changed(&good, edit, more)).unwrap();
        read_file(&path).map_err(|error| bad(Err::<(), _>(error)).what)
    };
    assert_eq!(case(&|_| (), 0).unwrap(), some_rays(50));
    // A dictionary page: its kind, its two sizes, and within field 7 how many numbers it has.
    let page = |page: &mut Vec<u8>| assert_eq!((page[0], page[1], page[2]), (0x15, 4, 0x15));
    let what = case(
        &|bytes| {
            page(bytes);
            claim(bytes, 3)
        },
        0,
    )
    .unwrap_err();
    assert!(what.contains("row group 0, column 5: a page of 6 bytes is said to unpack to 2147483647"), "{what}");
    let what = case(&|bytes| claim(bytes, 5), 0).unwrap_err();
    assert!(what.contains("column 5: a page of 2147483647 bytes is said to be in"), "{what}");
    let what = case(&|bytes| claim(bytes, 8), 0).unwrap_err();
    assert!(what.contains("a dictionary of 4 bytes is said to hold 2147483647 values"), "{what}");
    let what = case(&|_| (), 1 << 40).unwrap_err();
    assert!(what.contains("column 5: it is beyond the file"), "{what}");
}

#[test]
fn a_footer_that_claims_more_than_it_holds_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("rays.parquet");
    // Version 2, and a schema of 2^31 columns.
    let mut footer = vec![0x15, 4, 0x19, 0xfc];
    footer.extend([0xff, 0xff, 0xff, 0xff, 0x07, 0, 0]);
    let length = u32::try_from(footer.len()).unwrap().to_le_bytes();
    fs::write(&path, [b"PAR1", &footer[..], &length, b"PAR1"].concat()).unwrap();
    let refused = bad(read_file(&path));
    assert_eq!(
        (refused.place.as_str(), refused.what.as_str()),
        ("footer", "it is not a Parquet file: its footer is damaged")
    );
    fs::write(&path, [b"PAR1", &footer[..], &[255, 255, 255, 0], b"PAR1"].concat()).unwrap();
    assert!(bad(read_file(&path)).what.ends_with("its footer is longer than the file"));
}

#[test]
fn a_stream_that_is_none_is_refused_from_its_first_bytes() {
    // It has no end to wait for.
    let endless = Box::new(std::io::repeat(b'x'));
    let opened = crate::RayReader::from_pipe(Path::new("-"), endless, Some(Format::Parquet), crate::InvalidRays::Error);
    assert_eq!(bad(opened).what, "it does not start as a Parquet file does");
    assert_eq!(bad(read_pipe(b"", Some(Format::Parquet))).place, "header");
}
