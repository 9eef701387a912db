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
pub use dialect::{Dialect, Quirk};
pub use program::Program;
pub use span::{LineIndex, Place, Span};

use std::borrow::Cow;

/// The text that the bytes of a file are: UTF-8, or else one character per byte (Latin-1), as
/// old programs with an `µ` in a comment have it.
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}
