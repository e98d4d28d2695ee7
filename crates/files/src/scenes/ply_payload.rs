//! The values after a PLY header.
//!
//! Read here and not by ply-rs-bw, whose reader takes an ASCII line with a value too many, refuses `nan`, `.5` and
//! `1.` alike, and keeps no place for a message.

use super::ply_header::{Element, Encoding, Scalar, Type};
use super::reading::Reading;
use crate::decimal::Number;
use crate::quote::quoted;

/// The values not read yet.
pub(super) enum Payload<'a> {
    Ascii(Words<'a>),
    Binary { rest: &'a [u8], big: bool },
}

/// Whether all elements were there; how many, where the file ends before.
pub(super) type Whole = Result<(), usize>;

impl<'a> Payload<'a> {
    pub(super) const fn new(rest: &'a [u8], encoding: Encoding) -> Self {
        match encoding {
            Encoding::Ascii => Self::Ascii(Words::new(rest)),
            Encoding::LittleEndian | Encoding::BigEndian => {
                Self::Binary { rest, big: matches!(encoding, Encoding::BigEndian) }
            }
        }
    }

    /// `count`, or fewer if the rest of the file is too short for as many: a header may claim anything.
    pub(super) fn at_most(&self, count: usize) -> usize {
        let (Self::Ascii(Words { rest, .. }) | Self::Binary { rest, .. }) = self;
        count.min(rest.len())
    }

    /// Reads all elements of one kind and hands on three of the scalars of each.
    pub(super) fn points(
        &mut self,
        element: &Element,
        axes: [usize; 3],
        reading: &mut Reading<'_>,
        mut each: impl FnMut(usize, [Number; 3], &mut Reading<'_>),
    ) -> Whole {
        if let Some(whole) = self.rows(element, axes, |i, point| each(i, point, reading)) {
            return whole;
        }
        for i in 0..element.count {
            let mut point = [Number::default(); 3];
            let mut bad = None;
            self.begin(element, i);
            for (p, property) in element.properties.iter().enumerate() {
                match (axes.iter().position(|&axis| axis == p), property.ty) {
                    (Some(axis), Type::Scalar(ty)) => match self.scalar(ty).ok_or(i)? {
                        Ok(number) => point[axis] = number,
                        Err(word) => bad = bad.or(Some(word)),
                    },
                    (_, ty) => self.pass(ty).ok_or(i)?,
                }
            }
            if let Some(word) = bad {
                not_a_number(element, i, word, reading);
            }
            each(i, point, reading);
        }
        Ok(())
    }

    /// The same where each element has as many bytes: one look at each.
    fn rows(&mut self, element: &Element, axes: [usize; 3], mut each: impl FnMut(usize, [Number; 3])) -> Option<Whole> {
        let Self::Binary { rest, big } = self else { return None };
        let mut places = Vec::new();
        let mut stride = 0;
        for property in &element.properties {
            let Type::Scalar(ty) = property.ty else { return None };
            places.push((stride, ty));
            stride += ty.size();
        }
        let places = axes.map(|axis| places[axis]);
        let there = element.count.min(rest.len() / stride);
        let (rows, tail) = rest.split_at(there * stride);
        for (i, row) in rows.chunks_exact(stride).enumerate() {
            let mut point = [Number::default(); 3];
            for (number, (at, ty)) in point.iter_mut().zip(places) {
                *number = binary_scalar(&mut row.get(at..)?, ty, *big)?;
            }
            each(i, point);
        }
        *rest = tail;
        Some(if there < element.count { Err(there) } else { Ok(()) })
    }

    /// Reads all elements of one kind and hands on one of the lists of each.
    pub(super) fn lists(
        &mut self,
        element: &Element,
        list: usize,
        reading: &mut Reading<'_>,
        mut each: impl FnMut(usize, &[i64], &mut Reading<'_>),
    ) -> Whole {
        let mut values = Vec::new();
        for i in 0..element.count {
            self.begin(element, i);
            let mut bad = None;
            for (p, property) in element.properties.iter().enumerate() {
                match property.ty {
                    Type::List(length, of) if p == list => {
                        values.clear();
                        let length = match self.integer(length).ok_or(i)? {
                            Ok(length) => usize::try_from(length).ok().ok_or(i)?,
                            Err(word) => {
                                not_a_number(element, i, word, reading);
                                return Err(i);
                            }
                        };
                        for _ in 0..length {
                            match self.integer(of).ok_or(i)? {
                                Ok(value) => values.push(value),
                                Err(word) => bad = bad.or(Some(word)),
                            }
                        }
                    }
                    ty => self.pass(ty).ok_or(i)?,
                }
            }
            match bad {
                Some(word) => not_a_number(element, i, word, reading),
                None => each(i, &values, reading),
            }
        }
        Ok(())
    }

    /// Goes over all elements of one kind.
    pub(super) fn skip(&mut self, element: &Element) -> Whole {
        if element.properties.is_empty() {
            return Ok(());
        }
        for i in 0..element.count {
            self.begin(element, i);
            for property in &element.properties {
                self.pass(property.ty).ok_or(i)?;
            }
        }
        Ok(())
    }

    /// What follows the last element is told; or it is bad, where it may be a value that is out of place: where, and what.
    pub(super) fn end(self, reading: &mut Reading<'_>) -> Option<[String; 2]> {
        let (rest, astray) = match self {
            Self::Ascii(mut words) => {
                let apart = words.skip_space();
                let more = quoted(words.rest);
                match &words.astray {
                    _ if words.rest.is_empty() => {}
                    Some(place) => {
                        let what = format!("it does not stand on one line, and {more} follows the last element");
                        return Some([place.clone(), what]);
                    }
                    None if !apart => return Some(["the last line".into(), format!("{more} is a value too many")]),
                    None => {}
                }
                (words.rest, words.astray)
            }
            Self::Binary { rest, .. } => (rest, None),
        };
        if let Some(place) = astray {
            reading.note(format_args!("{place}"), "values are taken one after the other, whatever line they stand on");
        }
        if !rest.is_empty() {
            let what = format!("{} bytes after the last element are left out", rest.len());
            reading.note(format_args!("the end of the file"), &what);
        }
        None
    }

    fn begin(&mut self, element: &Element, i: usize) {
        if let Self::Ascii(words) = self {
            words.begin(&element.name, i);
        }
    }

    /// A scalar; or the word that stands there and is no number; `None` at the end of the file.
    fn scalar(&mut self, ty: Scalar) -> Option<Result<Number, &'a [u8]>> {
        match self {
            Self::Ascii(words) => {
                let word = words.next()?;
                Some(Number::parse(word).ok_or(word))
            }
            Self::Binary { rest, big } => binary_scalar(rest, ty, *big).map(Ok),
        }
    }

    /// An integer likewise.
    fn integer(&mut self, ty: Scalar) -> Option<Result<i64, &'a [u8]>> {
        match self {
            Self::Ascii(words) => {
                let word = words.next()?;
                let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
                Some(number.ok_or(word))
            }
            Self::Binary { rest, big } => Some(Ok(sign_extended(binary(rest, ty, *big)?, ty))),
        }
    }

    /// Goes over a value.
    fn pass(&mut self, ty: Type) -> Option<()> {
        let (length, of) = match ty {
            Type::Scalar(of) => (1, of),
            Type::List(length, of) => (usize::try_from(self.integer(length)?.ok()?).ok()?, of),
        };
        match self {
            Self::Ascii(words) => (0..length).try_for_each(|_| words.next().map(|_| ())),
            Self::Binary { rest, .. } => {
                *rest = rest.get(length.checked_mul(of.size())?..)?;
                Some(())
            }
        }
    }
}

fn not_a_number(element: &Element, i: usize, word: &[u8], reading: &mut Reading<'_>) {
    reading.fault(
        format_args!("{} {i} (counting from 0)", element.name),
        format_args!("{} is not a number of the type that the header declares", quoted(word)),
        "give the values that the header declares, and a list's length before it",
    );
}

/// The words of an ASCII payload, one after the other, and whether each element stands on a line of its own.
pub(super) struct Words<'a> {
    rest: &'a [u8],
    /// The element that is being read, and its number.
    element: (String, usize),
    /// The first that does not.
    astray: Option<String>,
}

impl<'a> Words<'a> {
    /// The words after the line of `end_header`.
    const fn new(rest: &'a [u8]) -> Self {
        Self { rest, element: (String::new(), 0), astray: None }
    }

    /// The next word is the first of an element.
    fn begin(&mut self, name: &str, i: usize) {
        let first = self.element.0.is_empty();
        if self.element.0 != name {
            name.clone_into(&mut self.element.0);
        }
        self.element.1 = i;
        let apart = self.skip_space() || first;
        self.is_astray(!apart);
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let astray = self.skip_space();
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        self.is_astray(astray && !word.is_empty());
        (!word.is_empty()).then_some(word)
    }

    fn is_astray(&mut self, astray: bool) {
        if astray && self.astray.is_none() {
            self.astray = Some(format!("{} {} (counting from 0)", self.element.0, self.element.1));
        }
    }

    /// Goes to the next word; whether that stands on another line.
    fn skip_space(&mut self) -> bool {
        let start = self.rest.trim_ascii_start();
        let space = &self.rest[..self.rest.len() - start.len()];
        self.rest = start;
        space.iter().any(|&byte| byte == b'\n' || byte == b'\r')
    }
}

/// A value's bytes as they stand, least significant first.
fn binary(rest: &mut &[u8], ty: Scalar, big: bool) -> Option<u64> {
    Some(match ty.size() {
        1 => take::<1>(rest, big)?[0].into(),
        2 => u16::from_le_bytes(take(rest, big)?).into(),
        4 => u32::from_le_bytes(take(rest, big)?).into(),
        _ => u64::from_le_bytes(take(rest, big)?),
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

#[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "integers beyond 2^53 are rounded")]
fn binary_scalar(rest: &mut &[u8], ty: Scalar, big: bool) -> Option<Number> {
    let value = binary(rest, ty, big)?;
    Some(match ty {
        Scalar::F32 => f32::from_bits(value as u32).into(),
        Scalar::F64 => f64::from_bits(value).into(),
        Scalar::U64 => (value as f64).into(),
        _ => (sign_extended(value, ty) as f64).into(),
    })
}

/// An integer of any type; one that is beyond them all is beyond every index.
fn sign_extended(value: u64, ty: Scalar) -> i64 {
    let unused = 64 - 8 * u32::try_from(ty.size()).expect("eight at most");
    match ty {
        Scalar::U64 => i64::try_from(value).unwrap_or(i64::MAX),
        Scalar::I8 | Scalar::I16 | Scalar::I32 | Scalar::I64 => (value << unused).cast_signed() >> unused,
        _ => value.cast_signed(),
    }
}
