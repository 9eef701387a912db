//! Byte ranges in a text, and their lines and columns.

use serde::Serialize;

/// A half-open range of bytes `start..end` in some text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The bytes `start..end`.
    pub const fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The empty range at `at`.
    pub const fn empty(at: usize) -> Self {
        Self { start: at, end: at }
    }

    /// From the start of `self` to the end of `other`.
    pub const fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end }
    }

    /// The same range, `offset` bytes further on.
    pub const fn shifted(self, offset: usize) -> Self {
        Self { start: self.start + offset, end: self.end + offset }
    }

    /// The text of the range; empty if the range is not inside `text`.
    pub fn of(self, text: &str) -> &str {
        text.get(self.start..self.end).unwrap_or("")
    }
}

/// A location as line and column; both begin at 1, columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct SourceLocation {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// Finds lines and columns in one text.
#[derive(Clone, Debug)]
pub struct LineIndex {
    starts: Vec<usize>,
}

impl LineIndex {
    /// The index of the lines of `text`.
    pub fn new(text: &str) -> Self {
        let after_breaks = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        Self { starts: std::iter::once(0).chain(after_breaks.map(|(i, _)| i + 1)).collect() }
    }

    /// Line of the byte at `offset`, from 1.
    pub fn line(&self, offset: usize) -> usize {
        self.starts.partition_point(|&start| start <= offset)
    }

    /// Line and column of the byte at `offset`; `text` is the text given to [`LineIndex::new`].
    pub fn location(&self, text: &str, offset: usize) -> SourceLocation {
        let line = self.line(offset);
        let start = self.starts[line - 1];
        let upto = text.get(start..offset.min(text.len())).unwrap_or("");
        SourceLocation { line, column: upto.chars().count() + 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn locations_count_lines_and_characters_from_one() {
        let text = "a\nµb\n";
        let lines = LineIndex::new(text);
        assert_eq!(lines.location(text, 0), SourceLocation { line: 1, column: 1 });
        assert_eq!(lines.location(text, 4), SourceLocation { line: 2, column: 2 });
        assert_eq!(lines.location(text, 6), SourceLocation { line: 3, column: 1 });
    }

    #[test]
    fn an_offset_after_the_end_has_a_location() {
        assert_eq!(LineIndex::new("ab").location("ab", 99).line, 1);
        assert_eq!(Span::new(1, 9).of("ab"), "");
    }
}
