//! Whether an output can go where it is sent: into a folder that is there, and not onto an input.

use std::fs;
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
