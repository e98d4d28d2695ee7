//! What a Parquet file says of its sizes, before the parquet crate believes it and reserves room.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

use parquet::arrow::ProjectionMask;
use parquet::basic::{Compression, Type};
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData};

use super::thrift::walk;

/// What the file starts and ends with.
pub(super) const MAGIC: &[u8; 4] = b"PAR1";

/// By how much snappy can shrink a page: its longest copy is 64 bytes, written in 3.
const MOST: u64 = 22;

/// Bytes that are read of a page for its header, at first.
const WINDOW: u64 = 1 << 12;

/// Walks over the footer.
///
/// # Errors
/// What is wrong: there is none, or a list in it claims more than there is.
pub(super) fn footer(file: &File) -> Result<(), String> {
    let size = file.metadata().map_err(text)?.len();
    let no_parquet = || "it does not end as one".to_owned();
    let tail_at = size.checked_sub(8).ok_or_else(no_parquet)?;
    let tail: [u8; 8] = read(file, tail_at, 8)?.try_into().map_err(|_| no_parquet())?;
    let [length @ .., _, _, _, _] = tail;
    if &tail[4..] != MAGIC {
        return Err(no_parquet());
    }
    let length = u64::from(u32::from_le_bytes(length));
    let start = tail_at.checked_sub(length).ok_or("its footer is longer than the file")?;
    let footer = read(file, start, length)?;
    walk(&footer, |_, _| ()).map(|_| ()).ok_or_else(|| "its footer is damaged".to_owned())
}

/// Walks over the headers of all pages of the columns that are read.
///
/// # Errors
/// What is wrong: a page that is not within its chunk, or that claims to unpack to more than it can.
pub(super) fn pages(file: &File, metadata: &ParquetMetaData, columns: &ProjectionMask) -> Result<(), String> {
    let size = file.metadata().map_err(text)?.len();
    for (i, group) in metadata.row_groups().iter().enumerate() {
        for (j, chunk) in group.columns().iter().enumerate().filter(|&(j, _)| columns.leaf_included(j)) {
            chunk_pages(file, chunk, size).map_err(|what| format!("row group {i}, column {j}: {what}"))?;
        }
    }
    Ok(())
}

fn chunk_pages(file: &File, chunk: &ColumnChunkMetaData, size: u64) -> Result<(), String> {
    if !matches!(chunk.compression(), Compression::UNCOMPRESSED | Compression::SNAPPY) {
        return Err(format!("it is packed by {}", chunk.compression()));
    }
    let start = chunk.dictionary_page_offset().unwrap_or_else(|| chunk.data_page_offset());
    let range = u64::try_from(start).ok().zip(u64::try_from(chunk.compressed_size()).ok());
    let end = range.and_then(|(start, length)| start.checked_add(length)).filter(|&end| end <= size);
    let (Some((mut at, _)), Some(end)) = (range, end) else {
        return Err("it is beyond the file".to_owned());
    };
    // Numbers take four bytes at least, and the length of a text does.
    let word = if chunk.column_type() == Type::FIXED_LEN_BYTE_ARRAY { 1 } else { 4 };
    while at < end {
        let (header, page) = page(file, at, end)?;
        let room = end - at - header;
        let (packed, unpacked) = (u64::try_from(page.packed), u64::try_from(page.unpacked));
        let (Ok(packed), Ok(unpacked)) = (packed, unpacked) else {
            return Err("a page has a negative size".to_owned());
        };
        if packed > room {
            return Err(format!("a page of {packed} bytes is said to be in {room}"));
        }
        if unpacked > packed.saturating_mul(MOST).saturating_add(WINDOW) {
            return Err(format!("a page of {packed} bytes is said to unpack to {unpacked}"));
        }
        if u64::try_from(page.words).is_ok_and(|words| words > unpacked / word) {
            return Err(format!("a dictionary of {unpacked} bytes is said to hold {} values", page.words));
        }
        at += header + packed;
    }
    Ok(())
}

/// What a page says of itself.
#[derive(Default)]
struct Page {
    packed: i64,
    unpacked: i64,
    /// How many values a dictionary has.
    words: i64,
}

/// The page at `at`, and how long its header is.
fn page(file: &File, at: u64, end: u64) -> Result<(u64, Page), String> {
    let mut window = WINDOW;
    loop {
        let bytes = read(file, at, window.min(end - at))?;
        let mut page = Page::default();
        let tell = |path: &[i16], value| match path {
            [2] => page.unpacked = value,
            [3] => page.packed = value,
            [7, 1] => page.words = value,
            _ => {}
        };
        if let Some(header) = walk(&bytes, tell) {
            return Ok((header as u64, page));
        }
        if window >= end - at {
            return Err("a page has no header".to_owned());
        }
        window *= 16;
    }
}

fn read(mut file: &File, at: u64, bytes: u64) -> Result<Vec<u8>, String> {
    let mut read = Vec::new();
    file.seek(SeekFrom::Start(at)).and_then(|_| file.take(bytes).read_to_end(&mut read)).map_err(text)?;
    Ok(read)
}

fn text(error: io::Error) -> String {
    error.to_string()
}
