use std::fmt;
use std::path::PathBuf;

/// Input that cannot be answered: it says what is wrong, where, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {place}: {what}{}; {expected}", first_of(*.more))]
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
