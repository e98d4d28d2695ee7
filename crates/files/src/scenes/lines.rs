//! The lines of a text, whoever wrote it: they end with LF, with CR LF, or with CR alone.

use memchr::memchr2;

/// A line without its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Line<'a> {
    /// Counting from 1.
    pub(super) number: usize,
    pub(super) text: &'a [u8],
}

pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

/// The lines of a whole file.
pub(super) fn lines(bytes: &[u8]) -> Lines<'_> {
    Lines { rest: text(bytes), number: 0 }
}

/// A whole file without the mark of UTF-8 before it, and the NUL or ^Z of old systems after.
pub(super) fn text(bytes: &[u8]) -> &[u8] {
    let mut text = without_mark(bytes);
    while let Some((0 | 0x1a, before)) = text.split_last() {
        text = before;
    }
    text
}

/// The bytes without the mark of UTF-8 before them.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = memchr2(b'\n', b'\r', self.rest).unwrap_or(self.rest.len());
        let (text, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
        Some(Line { number: self.number, text })
    }
}

/// The words of a line.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_end_of_a_line_is_one() {
        let read = |text: &[u8]| lines(text).map(|line| (line.number, line.text.to_vec())).collect::<Vec<_>>();
        let known = |texts: &[&[u8]]| (1..).zip(texts.iter().map(|text| text.to_vec())).collect::<Vec<_>>();
        assert_eq!(read(b"a\nb\r\nc\rd\n\ne\r\r\nf"), known(&[b"a", b"b", b"c", b"d", b"", b"e", b"", b"f"]));
        assert_eq!(read(b"\xEF\xBB\xBFa\n\x1a\0"), known(&[b"a"]));
        assert_eq!(read(b""), known(&[]));
    }
}
