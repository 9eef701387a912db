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

/// Decodes the bytes of a file: UTF-16 after its byte-order mark, UTF-8, or else Latin-1, as in old
/// programs with an `µ` in a comment.
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let utf16 = |unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> =
            bytes[2..].chunks(2).map(|b| unit([b[0], b.get(1).copied().unwrap_or(0)])).collect();
        Cow::Owned(String::from_utf16_lossy(&units))
    };
    match (bytes, std::str::from_utf8(bytes)) {
        ([0xff, 0xfe, ..], _) => utf16(u16::from_le_bytes),
        ([0xfe, 0xff, ..], _) => utf16(u16::from_be_bytes),
        (_, Ok(text)) => Cow::Borrowed(text),
        _ => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::decode;

    #[test]
    fn utf_16_utf_8_and_latin_1_are_told_apart() {
        let text = "µm 0.5";
        let units = || text.encode_utf16();
        let little: Vec<u8> =
            [0xff, 0xfe].into_iter().chain(units().flat_map(u16::to_le_bytes)).collect();
        let big: Vec<u8> =
            [0xfe, 0xff].into_iter().chain(units().flat_map(u16::to_be_bytes)).collect();
        for bytes in [&little, &big, text.as_bytes(), b"\xb5m 0.5"] {
            assert_eq!(decode(bytes), text);
        }
    }
}
