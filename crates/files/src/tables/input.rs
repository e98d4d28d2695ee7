use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

/// Where bytes come from: a file, which can be sought in, or a pipe, which cannot.
pub(super) enum Input {
    File(File),
    Pipe(Box<dyn Read + Send>),
}

impl Input {
    /// Goes forward by so many bytes; returns how many a pipe that ends before had.
    pub(super) fn skip(&mut self, bytes: u64) -> io::Result<u64> {
        match self {
            Self::File(file) => {
                let here = file.stream_position()?;
                file.seek(SeekFrom::Start(here.saturating_add(bytes)))?;
                Ok(bytes)
            }
            Self::Pipe(pipe) => io::copy(&mut pipe.take(bytes), &mut io::sink()),
        }
    }
}

impl Read for Input {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.read(bytes),
            Self::Pipe(pipe) => pipe.read(bytes),
        }
    }
}

impl Seek for Input {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::File(file) => file.seek(to),
            Self::Pipe(_) => Err(io::ErrorKind::NotSeekable.into()),
        }
    }
}
