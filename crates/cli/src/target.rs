//! Whether an output can go where it is sent: into a folder that is there, and not onto an input; and how it appears there whole.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use crate::exit::{Code, Failure};

/// # Errors
/// Where the folder of `output` does not exist.
pub(crate) fn has_folder(output: &Path) -> Result<(), Failure> {
    match output.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.exists() => {
            let (output, folder) = (output.display(), folder.display());
            Err(Failure::new(Code::Running, format!("--output: {output}: the folder {folder} does not exist")))
        }
        _ => Ok(()),
    }
}

/// # Errors
/// A usage error where `output` is the same file as one of `inputs`, under whatever name.
pub(crate) fn is_no_input<'a>(output: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    // Only a file can be lost: a terminal may well be both ends. `-` is stdin or stdout.
    let file = |path: &Path| fs::canonicalize(path).ok().filter(|path| path.is_file());
    let Some(target) = file(output).filter(|_| output.as_os_str() != "-") else { return Ok(()) };
    let same = |input: &&Path| input.as_os_str() != "-" && file(input).as_ref() == Some(&target);
    match inputs.into_iter().find(same) {
        Some(input) => {
            let (output, input) = (output.display(), input.display());
            let message = format!("--output: {output} is the input {input}, which would be lost; give another name");
            Err(Failure::new(Code::Usage, message))
        }
        None => Ok(()),
    }
}

/// Writes a file by way of a temporary one beside it, which takes its name when it is whole.
pub(crate) fn replace(path: &Path, write: impl FnOnce(&File) -> io::Result<()>) -> io::Result<()> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".rayproof-").suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    write(file.as_file())?;
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}
