#![doc = include_str!("../README.md")]

pub mod archive;
pub mod convert;
pub mod diagnostic;
pub mod dialect;
pub mod expr;
pub mod number;
pub mod optics;
pub mod program;
pub mod span;
pub mod suggestion;
pub mod table;

pub use diagnostic::{Diagnostic, Note, Severity};
pub use dialect::{Dialect, TextDeviation};
pub use program::Program;
pub use span::{LineIndex, SourceLocation, Span};

use std::borrow::Cow;

/// Decodes the bytes of a file: UTF-8, or else Latin-1, as in old programs with an `µ` in a comment.
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}
