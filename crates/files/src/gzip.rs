//! Files that gzip has packed: `.gz` after the ending of what is in them.

use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

use crate::Error;

/// By how much, and by how many bytes more, a file may unpack: a packed file of nothing but one byte becomes a thousand times as
/// long, and no scene does.
const MOST: (u64, u64) = (64, 64 << 20);

/// The path without `.gz`, where it has that.
pub(crate) fn unpacked_name(path: &Path) -> Option<PathBuf> {
    path.extension().filter(|ending| ending.eq_ignore_ascii_case("gz")).map(|_| path.with_extension(""))
}

/// What unpacks as it is read.
pub(crate) fn unpacking(packed: impl Read + Send + 'static) -> Box<dyn Read + Send> {
    Box::new(MultiGzDecoder::new(BufReader::with_capacity(1 << 20, packed)))
}

/// The whole content of a packed file.
pub(crate) fn unpack(path: &Path, packed: &[u8]) -> Result<Vec<u8>, Error> {
    let bad =
        |what: String| Error::bad(path.display().to_string(), "the file", what, "give a whole file, packed by gzip");
    let most = (packed.len() as u64).saturating_mul(MOST.0).saturating_add(MOST.1);
    let mut bytes = Vec::new();
    let read = MultiGzDecoder::new(packed).take(most + 1).read_to_end(&mut bytes);
    match read {
        Err(e) if e.kind() == io::ErrorKind::OutOfMemory => Err(Error::Io { path: path.into(), source: e }),
        Err(e) => Err(bad(format!("it cannot be unpacked: {e}"))),
        Ok(length) if length as u64 > most => Err(bad(format!("it unpacks to more than {} times its size", MOST.0))),
        Ok(_) => Ok(bytes),
    }
}
