//! The header of a PLY file: which elements follow, and of what values each is made.
//!
//! Read here and not by ply-rs-bw, which refuses lines that end with CR, blank lines, comments that are not UTF-8 and integers of
//! 64 bits, and keeps only the last of two properties of one name.

use super::lines::{without_mark, words};
use crate::Error;
use crate::quote::quoted;

#[derive(Debug)]
pub(super) struct PlyHeader {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Property {
    name: String,
    pub(super) ty: Type,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Scalar(Scalar),
    /// Of which type the length is, and of which the values.
    List(Scalar, Scalar),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"long" | b"int64" => Self::I64,
            b"ulong" | b"uint64" => Self::U64,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// In bytes.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    pub(super) const fn is_integer(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

impl Element {
    /// The place of a property among the others.
    ///
    /// # Errors
    /// When two have the name: which is meant?
    pub(super) fn property(&self, file: &str, name: &str) -> Result<Option<usize>, Error> {
        let mut found = self.properties.iter().enumerate().filter(|(_, p)| p.name == name).map(|(i, _)| i);
        let (first, second) = (found.next(), found.next());
        if second.is_some() {
            let what = format!("the property {name} is declared twice");
            return Err(Error::bad(file, format!("element `{}`", self.name), what, "give it once"));
        }
        Ok(first)
    }
}

impl PlyHeader {
    /// The header, and what follows it.
    pub(super) fn read<'a>(file: &str, bytes: &'a [u8]) -> Result<(Self, &'a [u8]), Error> {
        let mut lines = HeaderLines::new(without_mark(bytes));
        let bad = |number: usize, what: String, expected: &str| {
            Error::bad(file, if number == 0 { "the header".into() } else { format!("line {number}") }, what, expected)
        };
        let all = "give a PLY header: ply, format, element, property, end_header";
        if lines.next().is_none_or(|line| line.trim_ascii() != b"ply") {
            return Err(bad(1, "it does not begin with `ply`".into(), all));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        loop {
            let Some(line) = lines.next() else {
                return Err(bad(0, "the file ends before `end_header`".into(), all));
            };
            let words: Vec<&[u8]> = words(line).take(6).collect();
            let wrong = |expected| Err(bad(lines.number, format!("this is {}", quoted(line)), expected));
            match words[..] {
                [b"end_header"] => break,
                [] | [b"comment" | b"obj_info", ..] => {}
                [b"format", b"ascii", _] => encoding = Some(Encoding::Ascii),
                [b"format", b"binary_little_endian", _] => encoding = Some(Encoding::LittleEndian),
                [b"format", b"binary_big_endian", _] => encoding = Some(Encoding::BigEndian),
                [b"format", ..] => {
                    return wrong("give `format` with ascii, binary_little_endian or binary_big_endian, and 1.0");
                }
                [b"element", name, count] => {
                    let count = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok());
                    let Some(count) = count else { return wrong("give `element`, a name and how many there are") };
                    let name = String::from_utf8_lossy(name).into_owned();
                    elements.push(Element { name, count, properties: Vec::new() });
                }
                [b"property", .., name] if words.len() == 3 || words.len() == 5 => {
                    let ty = match words[1..words.len() - 1] {
                        [ty] => Scalar::named(ty).map(Type::Scalar),
                        [b"list", length, ty] => Scalar::named(length)
                            .filter(|length| length.is_integer())
                            .and_then(|length| Some(Type::List(length, Scalar::named(ty)?))),
                        _ => None,
                    };
                    let Some((ty, element)) = ty.zip(elements.last_mut()) else {
                        return wrong("after an element give `property TYPE NAME` or `property list TYPE TYPE NAME`");
                    };
                    element.properties.push(Property { name: String::from_utf8_lossy(name).into_owned(), ty });
                }
                _ => return wrong(all),
            }
        }
        let Some(encoding) = encoding else {
            return Err(bad(0, "it has no `format`".into(), all));
        };
        for name in ["vertex", "face", "tristrips"] {
            if elements.iter().filter(|element| element.name == name).count() > 1 {
                return Err(bad(0, format!("the element {name} is declared twice"), "give it once"));
            }
        }
        Ok((Self { encoding, elements }, lines.rest))
    }

    pub(super) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

/// The lines up to the payload, which end as the first does: values may look like the end of a line.
struct HeaderLines<'a> {
    rest: &'a [u8],
    end: u8,
    /// Of the line read last, counting from 1.
    number: usize,
}

impl<'a> HeaderLines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let first = memchr::memchr2(b'\n', b'\r', bytes).unwrap_or(0);
        let end = if bytes[first..].starts_with(b"\r") && !bytes[first..].starts_with(b"\r\n") { b'\r' } else { b'\n' };
        Self { rest: bytes, end, number: 0 }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let end = memchr::memchr(self.end, self.rest);
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let line = &self.rest[..end.unwrap_or(self.rest.len())];
        self.rest = end.map_or(&[], |end| &self.rest[end + 1..]);
        Some(line)
    }
}
