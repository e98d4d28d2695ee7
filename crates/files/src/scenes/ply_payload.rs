//! The values after a PLY header.
//!
//! Read here and not by ply-rs-bw, whose reader takes an ASCII line with a value too many, refuses `nan`, `.5` and
//! `1.` alike, and keeps no place for a message.

use ply_rs_bw::ply::{ElementDef, Encoding, PropertyType, ScalarType};

use super::faults::Faults;
use crate::Error;

/// The values not read yet.
pub(super) struct Payload<'a> {
    file: &'a str,
    rest: &'a [u8],
    encoding: Encoding,
    faults: Faults<'a>,
}

/// The values of one element, by the index of its property. Every type of PLY is exact in an f64.
#[derive(Default)]
pub(super) struct Row {
    /// Scalars; 0 where the property is a list.
    pub(super) scalars: Vec<f64>,
    /// Lists; empty where the property is a scalar.
    pub(super) lists: Vec<Vec<f64>>,
}

impl<'a> Payload<'a> {
    pub(super) const fn new(file: &'a str, rest: &'a [u8], encoding: Encoding) -> Self {
        Self { file, rest, encoding, faults: Faults::new(file) }
    }

    /// `count`, or fewer if the rest of the file is too short for as many: a header may claim anything.
    pub(super) fn at_most(&self, count: usize) -> usize {
        count.min(self.rest.len())
    }

    /// Reads all elements of one kind and hands on each, with its number.
    ///
    /// # Errors
    /// When the file ends too early.
    pub(super) fn elements(
        &mut self,
        element: &ElementDef,
        mut each: impl FnMut(usize, &Row, &mut Faults<'a>),
    ) -> Result<(), Error> {
        let types: Vec<_> = element.properties.values().map(|p| &p.data_type).collect();
        if types.is_empty() {
            return Ok(());
        }
        let mut row = Row { scalars: vec![0.0; types.len()], lists: vec![Vec::new(); types.len()] };
        for i in 0..element.count {
            let read = match self.encoding {
                Encoding::Ascii => self.line().map(|line| {
                    let mut words = line.split_ascii_whitespace();
                    row.read(&types, |ty| number(words.next()?, ty)).filter(|()| words.next().is_none()).ok_or(line)
                }),
                Encoding::BinaryLittleEndian => row.read(&types, |ty| scalar(&mut self.rest, ty, false)).map(Ok),
                Encoding::BinaryBigEndian => row.read(&types, |ty| scalar(&mut self.rest, ty, true)).map(Ok),
            };
            match read {
                Some(Ok(())) => each(i, &row, &mut self.faults),
                Some(Err(line)) => self.faults.add(
                    format_args!("{} {i} (counting from 0)", element.name),
                    format_args!("`{}` is not the values that the header declares", line.trim()),
                    "give one line an element, with its values as numbers and a list's length before it",
                ),
                None => return Err(self.truncated(element, i)),
            }
        }
        Ok(())
    }

    /// # Errors
    /// When there is more than the header declares, or when an element was bad.
    pub(super) fn end(self) -> Result<(), Error> {
        self.faults.none()?;
        let more = self.rest.trim_ascii().len();
        if more > 0 {
            let what = format!("{more} bytes follow that the header does not declare");
            return Err(Error::bad(self.file, "the end of the file", what, "declare as many elements as there are"));
        }
        Ok(())
    }

    /// The next line that is not blank.
    fn line(&mut self) -> Option<std::borrow::Cow<'a, str>> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|&b| b == b'\n').map_or(self.rest.len(), |newline| newline + 1);
            let (line, rest) = self.rest.split_at(end);
            self.rest = rest;
            if !line.trim_ascii().is_empty() {
                return Some(String::from_utf8_lossy(line));
            }
        }
        None
    }

    fn truncated(&self, element: &ElementDef, i: usize) -> Error {
        let (name, count) = (&element.name, element.count);
        let what = format!("the file ends here, or a list has a negative length; the header declares {count}");
        Error::bad(self.file, format!("{name} {i} (counting from 0)"), what, "give the whole file")
    }
}

impl Row {
    fn read(&mut self, types: &[&PropertyType], mut next: impl FnMut(&ScalarType) -> Option<f64>) -> Option<()> {
        for (i, ty) in types.iter().enumerate() {
            match ty {
                PropertyType::Scalar(ty) => self.scalars[i] = next(ty)?,
                PropertyType::List(length, ty) => {
                    self.lists[i].clear();
                    let mut left = next(length).filter(|&length| length >= 0.0)?;
                    while left >= 1.0 {
                        self.lists[i].push(next(ty)?);
                        left -= 1.0;
                    }
                }
            }
        }
        Some(())
    }
}

/// An ASCII value.
fn number(word: &str, ty: &ScalarType) -> Option<f64> {
    match ty {
        // Rounded once, from the decimals.
        ScalarType::Float => word.parse::<f32>().ok().map(f64::from),
        ScalarType::Double => word.parse().ok(),
        ScalarType::Char | ScalarType::Short | ScalarType::Int => word.parse::<i32>().ok().map(f64::from),
        ScalarType::UChar | ScalarType::UShort | ScalarType::UInt => word.parse::<u32>().ok().map(f64::from),
    }
}

/// A binary value.
fn scalar(rest: &mut &[u8], ty: &ScalarType, big: bool) -> Option<f64> {
    Some(match ty {
        ScalarType::Char => i8::from_le_bytes(take(rest, big)?).into(),
        ScalarType::UChar => u8::from_le_bytes(take(rest, big)?).into(),
        ScalarType::Short => i16::from_le_bytes(take(rest, big)?).into(),
        ScalarType::UShort => u16::from_le_bytes(take(rest, big)?).into(),
        ScalarType::Int => i32::from_le_bytes(take(rest, big)?).into(),
        ScalarType::UInt => u32::from_le_bytes(take(rest, big)?).into(),
        ScalarType::Float => f32::from_le_bytes(take(rest, big)?).into(),
        ScalarType::Double => f64::from_le_bytes(take(rest, big)?),
    })
}

/// The next `N` bytes, least significant first.
fn take<const N: usize>(rest: &mut &[u8], big: bool) -> Option<[u8; N]> {
    let (&(mut value), tail) = rest.split_first_chunk()?;
    *rest = tail;
    if big {
        value.reverse();
    }
    Some(value)
}
