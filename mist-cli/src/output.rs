//! Standard output.

use std::io::{ErrorKind, Write};

use super::error::CommandError;

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
