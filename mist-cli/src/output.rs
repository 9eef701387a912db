//! Standard output, and files that are written at once.

use std::{
    io::{ErrorKind, Write},
    path::Path,
};

use mist_runner::files::AtomicFile;

use super::{error::CommandError, progress, report};

/// Writes `text` to standard output.
///
/// # Errors
///
/// If it cannot be written; a reader that has closed the pipe is not an error.
pub(super) fn print(text: &str) -> Result<(), CommandError> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => {
            other.map_err(|error| CommandError::Failed(format!("cannot write the output: {error}")))
        }
    }
}

/// Writes the file `path`; a note tells that it replaces an older one, unless the command is quiet.
///
/// # Errors
///
/// If it cannot be written.
pub(super) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CommandError> {
    let replaces = AtomicFile::write_bytes(path, bytes).map_err(|error| {
        CommandError::Failed(format!("cannot write {}: {error}", path.display()))
    })?;
    if replaces && !progress::is_quiet() {
        report::print_line(&format!("note: {} replaces an older file", path.display()));
    }
    Ok(())
}
