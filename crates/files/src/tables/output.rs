use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::format::is_standard_stream;

/// The buffer in front of the system, in bytes.
const BUFFER: usize = 1 << 20;

/// Where a table goes. Nothing appears under a file's name before [`finish`](Self::finish).
pub(super) enum Output {
    /// A file under a name of its own beside the target until it is whole; removed when dropped.
    Beside { file: BufWriter<NamedTempFile>, target: PathBuf },
    /// A pipe or a device, which takes the bytes as they come.
    Stream(BufWriter<Box<dyn Write + Send>>),
    /// A pipe whose first bytes depend on the last: all wait in a file without a name.
    Spool { file: BufWriter<File>, to: Box<dyn Write + Send> },
}

impl Output {
    /// Opens the way to `path`, stdout for `-`; `patched` if [`rewrite_start`](Self::rewrite_start) will be called.
    pub(super) fn create(path: &Path, patched: bool) -> io::Result<Self> {
        if is_standard_stream(path) {
            return Self::stream(Box::new(io::stdout()), patched);
        }
        // A link stays one: the file that it leads to is replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        match fs::metadata(&target) {
            Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            // A device or a named pipe is written to, not replaced by a file.
            Ok(metadata) if !metadata.is_file() => {
                Self::stream(Box::new(File::options().write(true).open(&target)?), patched)
            }
            _ => Self::beside(target),
        }
    }

    /// The way into a pipe.
    pub(super) fn stream(to: Box<dyn Write + Send>, patched: bool) -> io::Result<Self> {
        Ok(if patched {
            Self::Spool { file: BufWriter::with_capacity(BUFFER, tempfile::tempfile()?), to }
        } else {
            Self::Stream(BufWriter::with_capacity(BUFFER, to))
        })
    }

    fn beside(target: PathBuf) -> io::Result<Self> {
        let name = target.file_name().ok_or(io::ErrorKind::InvalidInput)?.to_string_lossy();
        // A killed run leaves this file: its name says whose it is and that it is not whole.
        let prefix = format!(".{name}.");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".partial");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What any new file gets, less the umask; a temporary file is private by default.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let directory = target.parent().filter(|d| !d.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let file = BufWriter::with_capacity(BUFFER, builder.tempfile_in(directory)?);
        Ok(Self::Beside { file, target })
    }

    /// Replaces the first bytes. Not for a stream, whose first bytes are gone: there it does nothing.
    pub(super) fn rewrite_start(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Self::Beside { file, .. } => {
                file.rewind()?;
                file.write_all(bytes)
            }
            Self::Spool { file, .. } => {
                file.rewind()?;
                file.write_all(bytes)
            }
            Self::Stream(_) => Ok(()),
        }
    }

    /// Makes it whole: a file takes its name, a pipe its last bytes.
    pub(super) fn finish(self) -> io::Result<()> {
        match self {
            Self::Beside { file, target } => {
                let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                file.persist(target).map_err(|error| error.error)?;
                Ok(())
            }
            Self::Stream(mut to) => to.flush(),
            Self::Spool { file, mut to } => {
                let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
                file.rewind()?;
                io::copy(&mut file, &mut to)?;
                to.flush()
            }
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Beside { file, .. } => file.write(bytes),
            Self::Stream(to) => to.write(bytes),
            Self::Spool { file, .. } => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Beside { file, .. } => file.flush(),
            Self::Stream(to) => to.flush(),
            Self::Spool { file, .. } => file.flush(),
        }
    }
}
