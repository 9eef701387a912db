//! The rows of a text table and its last line.

use std::fmt::Write as _;

use mist_format::number::general;
use sha2::{Digest, Sha256};

use super::error::WriteError;

/// TextRows of numbers, and the line that proves them complete.
pub(super) struct TextRows<'a> {
    names: &'a [String],
    digits: usize,
    text: String,
    count: usize,
}

impl<'a> TextRows<'a> {
    /// An empty table; `names` are the columns, for errors.
    pub(super) fn new(names: &'a [String], digits: usize) -> Self {
        Self { names, digits, text: String::new(), count: 0 }
    }

    /// Adds the row `values`, and `flags` in a column of their own.
    ///
    /// # Errors
    ///
    /// If a value is not finite.
    pub(super) fn push(&mut self, values: &[f64], flags: Option<u8>) -> Result<(), WriteError> {
        finite(self.count, self.names, values)?;
        self.count += 1;
        for (i, value) in values.iter().enumerate() {
            self.text.push_str(if i == 0 { "" } else { " " });
            self.text.push_str(&number(*value, self.digits));
        }
        if let Some(flags) = flags {
            // Writing to a string cannot fail.
            let _ = write!(self.text, " {flags}");
        }
        self.text.push('\n');
        Ok(())
    }

    /// The rows and `# end ROWS CHECKSUM`.
    pub(super) fn finish(mut self) -> String {
        let checksum = checksum(self.text.as_bytes());
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "# end {} {checksum}", self.count);
        self.text
    }
}

/// The text of `x` with `digits` significant digits; zero has no sign.
pub(super) fn number(x: f64, digits: usize) -> String {
    general(x + 0.0, digits)
}

/// Checks that `values` are finite; `row` counts from 0.
///
/// # Errors
///
/// At the first value that is not finite.
pub(super) fn finite(row: usize, names: &[String], values: &[f64]) -> Result<(), WriteError> {
    match values.iter().zip(names).find(|(value, _)| !value.is_finite()) {
        None => Ok(()),
        Some((value, name)) => {
            Err(WriteError::NotFinite { row: row + 1, column: name.clone(), value: *value })
        }
    }
}

/// The first sixteen hexadecimal digits of the SHA-256 of `bytes`.
pub(crate) fn checksum(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}
