//! The header of an `.npy` file: `\x93NUMPY`, a version, a length and a Python dictionary.
//!
//! Parsed here and not by npyz 0.9, which panics on a shape whose product overflows, on deeply nested brackets and on
//! some number expressions: a file is never a reason to crash. Tables of rays and of spheres share it.

use std::io::{self, Read};

use crate::quote::{cut, quoted};

/// The magic number.
const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// The longest header that is read, in bytes; NumPy's own limit.
const MAX_HEADER: usize = 10_000;

/// What the header says, not yet judged.
#[derive(Debug)]
pub(crate) struct Header {
    /// The dtype as a Python literal, for example `'<f4'` with its quotes.
    pub(crate) descr: String,
    /// Whether the first axis runs fastest.
    pub(crate) fortran_order: bool,
    /// The shape as a Python literal, for example `(10, 6)`.
    pub(crate) shape: String,
    /// How many bytes the header takes, magic and all.
    pub(crate) bytes: u64,
}

/// Why there is no header.
#[derive(Debug, thiserror::Error)]
pub(crate) enum HeaderError {
    /// What is wrong with it.
    #[error("{0}")]
    Bad(String),
    /// Reading failed.
    #[error(transparent)]
    Io(io::Error),
}

impl From<io::Error> for HeaderError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::Bad("the file ends within its header".to_owned()),
            _ => Self::Io(error),
        }
    }
}

impl Header {
    /// Reads a header; the input then stands at the first byte of the data.
    pub(crate) fn read(input: &mut impl Read) -> Result<Self, HeaderError> {
        let mut start = [0; 8];
        input.read_exact(&mut start)?;
        let [magic @ .., major, minor] = start;
        if &magic != MAGIC {
            return Err(HeaderError::Bad("it does not start with the .npy magic number".to_owned()));
        }
        let (size, length) = match major {
            1 => {
                let mut length = [0; 2];
                input.read_exact(&mut length)?;
                (2, usize::from(u16::from_le_bytes(length)))
            }
            2 | 3 => {
                let mut length = [0; 4];
                input.read_exact(&mut length)?;
                (4, usize::try_from(u32::from_le_bytes(length)).expect("32 bits"))
            }
            _ => return Err(HeaderError::Bad(format!("the .npy version {major}.{minor} is not known"))),
        };
        if length > MAX_HEADER {
            return Err(HeaderError::Bad(format!("the header has {length} bytes, more than {MAX_HEADER}")));
        }
        let mut text = vec![0; length];
        input.read_exact(&mut text)?;
        let text = String::from_utf8_lossy(&text);
        let (descr, fortran_order, shape) = dictionary(&text).ok_or_else(|| {
            HeaderError::Bad(format!("the header is not a dictionary of an array: {}", quoted(&*text)))
        })?;
        Ok(Self { descr, fortran_order, shape, bytes: (start.len() + size + length) as u64 })
    }

    /// What is said of a dtype and of a shape that are not wanted.
    pub(crate) fn wrong_descr(&self) -> String {
        format!("the dtype is {}", cut(&self.descr))
    }

    /// See [`wrong_descr`](Self::wrong_descr).
    pub(crate) fn wrong_shape(&self) -> String {
        format!("the shape is {}", cut(&self.shape))
    }

    /// The shape as numbers, if it is a tuple of them.
    pub(crate) fn dimensions(&self) -> Option<Vec<u64>> {
        let inner = self.shape.strip_prefix('(')?.strip_suffix(')')?.trim();
        let inner = inner.strip_suffix(',').unwrap_or(inner);
        if inner.is_empty() {
            return Some(Vec::new());
        }
        inner.split(',').map(|n| n.trim().parse().ok()).collect()
    }
}

/// `descr`, `fortran_order` and `shape` of the dictionary, each exactly once, and nothing else.
fn dictionary(text: &str) -> Option<(String, bool, String)> {
    let inner = text.trim().strip_prefix('{')?.strip_suffix('}')?;
    let (mut descr, mut order, mut shape) = (None, None, None);
    for entry in entries(inner).into_iter().map(str::trim).filter(|entry| !entry.is_empty()) {
        let (key, value) = entry.split_once(':')?;
        let value = value.trim();
        let replaced = match key.trim().trim_matches(['\'', '"']) {
            "descr" => descr.replace(value.to_owned()).is_some(),
            "fortran_order" => order
                .replace(match value {
                    "True" => true,
                    "False" => false,
                    _ => return None,
                })
                .is_some(),
            "shape" => shape.replace(value.to_owned()).is_some(),
            _ => return None,
        };
        if replaced {
            return None;
        }
    }
    Some((descr?, order?, shape?))
}

/// The parts between the commas that are outside of brackets and strings.
fn entries(text: &str) -> Vec<&str> {
    let (mut depth, mut quote, mut start) = (0_usize, None, 0);
    let mut entries = Vec::new();
    for (i, c) in text.char_indices() {
        match (quote, c) {
            (Some(q), c) if c == q => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') => quote = Some(c),
            (None, '(' | '[' | '{') => depth += 1,
            (None, ')' | ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                entries.push(&text[start..i]);
                start = i + 1;
            }
            (None, _) => {}
        }
    }
    entries.push(&text[start..]);
    entries
}

/// A header for `rows` rows, of the same length for any number of rows, so that it can be written again.
///
/// `shape` turns the number of rows into the shape's literal.
pub(crate) fn header(descr: &str, shape: impl Fn(u64) -> String, rows: u64) -> Vec<u8> {
    let dictionary =
        |rows| format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {}, }}", shape(rows)).into_bytes();
    // Magic, version, length and the closing newline are 11 bytes; the data starts at a multiple of 64.
    let whole = (dictionary(u64::MAX).len() + 11).next_multiple_of(64);
    let length = u16::try_from(whole - 10).expect("a header of ours is short");
    let mut bytes = [&MAGIC[..], &[1, 0], &length.to_le_bytes(), &dictionary(rows)].concat();
    bytes.resize(whole - 1, b' ');
    bytes.push(b'\n');
    bytes
}
