use std::fmt::{self, Write as _};
use std::path::PathBuf;

/// Input that cannot be answered: it says what is wrong, where, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}: {}: {}{}; {}", Plain(name(.file)), Plain(.place), Plain(.what), first_of(*.more), Plain(.expected))]
pub struct BadInput {
    /// The file, as it was named; `-` is stdin.
    pub file: String,
    /// The line, row or element, for example `line 12` or `row 3 (counting from 0)`.
    pub place: String,
    /// What is wrong there.
    pub what: String,
    /// How many more places are wrong in the same way.
    pub more: usize,
    /// What would be right.
    pub expected: String,
}

/// Text for a message, whoever wrote it: on one line, with nothing in it that a terminal would obey, and no longer than a reader
/// wants. What readers quote is shorter; this is for the words of others, and for names.
pub(crate) struct Plain<'a>(pub(crate) &'a str);

impl fmt::Display for Plain<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LONGEST: usize = 240;
        let mut length = 0;
        for character in self.0.chars() {
            // What `escape_default` writes is ten characters at most.
            length += if character.is_control() { 10 } else { 1 };
            match character {
                _ if length > LONGEST => return f.write_str(".."),
                '\n' | '\t' => f.write_str(" ")?,
                c if c.is_control() => write!(f, "{}", c.escape_default())?,
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

/// A file's name, also one of no letters.
const fn name(file: &str) -> &str {
    if file.is_empty() { "''" } else { file }
}

/// What is said after a place where there are more like it.
pub(crate) fn first_of(more: usize) -> String {
    match more {
        0 => String::new(),
        n => format!(" (the first of {})", n + 1),
    }
}

/// Why a file could not be read or written.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The content is bad: exit code 5.
    Bad(Box<BadInput>),
    /// The input could not be opened: exit code 5.
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Reading or writing failed under way: exit code 1.
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bad(bad) => write!(f, "{bad}"),
            Self::Open { path, source } => {
                write!(f, "{}: cannot be opened: {source}; give a file that exists and can be read", path.display())
            }
            Self::Io { path, source } => write!(f, "{}: {source}", path.display()),
        }
    }
}

/// Without a source: what the system said is in the text, and a chain of causes would say it twice.
impl std::error::Error for Error {}

impl From<Box<BadInput>> for Error {
    fn from(bad: Box<BadInput>) -> Self {
        Self::Bad(bad)
    }
}

impl Error {
    /// A [`BadInput`] with nothing more wrong than the one place.
    pub fn bad(
        file: impl Into<String>,
        place: impl Into<String>,
        what: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let (file, place, what, expected) = (file.into(), place.into(), what.into(), expected.into());
        Self::Bad(Box::new(BadInput { file, place, what, more: 0, expected }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_of_one_short_line_whoever_wrote_their_words() {
        let bad = Error::bad("a\u{1b}.ply", "fac\0e 0", "two\nlines", "x".repeat(5_000_000));
        assert_eq!(bad.to_string(), format!("a\\u{{1b}}.ply: fac\\u{{0}}e 0: two lines; {}..", "x".repeat(240)));
        assert_eq!(Error::bad("", "name", "it is empty", "give one").to_string(), "'': name: it is empty; give one");
    }
}
