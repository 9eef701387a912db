//! A text of a program with its location.

use crate::diagnostic::{Diagnostic, Note};
use crate::span::Span;

/// A text taken from a program.
///
/// The text may differ from what the span covers: quotes are not part of it, and a comment
/// inside quotes is cut out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceText {
    text: String,
    span: Span,
    quoted: bool,
    /// (offset in the text, offset in the program) of each unbroken piece; at least one.
    pieces: Vec<(usize, usize)>,
}

impl SourceText {
    /// `text` that begins at the byte `at` of the program.
    pub fn new(text: impl Into<String>, at: usize) -> Self {
        let text = text.into();
        let span = Span::new(at, at + text.len());
        Self { text, span, quoted: false, pieces: vec![(0, at)] }
    }

    /// A text with its location: `span` includes the quotes; `pieces` are the (offset in the text,
    /// offset in the program) of its parts between comments.
    pub(crate) fn read(
        text: String,
        span: Span,
        quoted: bool,
        pieces: Vec<(usize, usize)>,
    ) -> Self {
        Self { text, span, quoted, pieces }
    }

    /// Another text that is taken to stand at the beginning of this one.
    #[must_use]
    pub fn with_text(&self, text: &str) -> Self {
        let at = self.span.start;
        // Every byte has the same place: no part of the text reaches beyond the program.
        let pieces = (0..text.len().max(1)).map(|offset| (offset, at)).collect();
        Self { text: text.to_owned(), span: self.span, quoted: false, pieces }
    }

    /// The text without its location, for the comparison of programs in different layouts.
    pub fn without_location(self) -> Self {
        Self { span: Span::default(), pieces: vec![(0, 0)], ..self }
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Its span in the program, quotes included.
    pub fn span(&self) -> Span {
        self.span
    }

    /// True if it was written in quotes.
    pub fn is_quoted(&self) -> bool {
        self.quoted
    }

    /// The span of a part of the text in the program.
    pub fn locate(&self, part: Span) -> Span {
        let last = part.end.saturating_sub(1).max(part.start);
        let start = self.place(part.start);
        Span::new(start, if part.end > part.start { self.place(last) + 1 } else { start })
    }

    /// A diagnostic of the text (such as an error in an expression) as one of the program.
    pub fn diagnose(&self, found: Diagnostic) -> Diagnostic {
        let span = self.locate(found.span);
        let place = |note: Note| Note { span: note.span.map(|span| self.locate(span)), ..note };
        let notes = found.notes.into_iter().map(place).collect();
        Diagnostic { span, notes, ..found }
    }

    /// A part of the text with its location.
    pub fn part(&self, range: std::ops::Range<usize>) -> Self {
        let text = self.text.get(range.clone()).unwrap_or("").to_owned();
        let span = self.locate(Span::new(range.start, range.end));
        let inside = self.pieces.iter().filter(|piece| range.contains(&piece.0));
        let later = inside.map(|piece| (piece.0 - range.start, piece.1));
        let first = (0, self.place(range.start));
        let pieces = std::iter::once(first).chain(later.filter(|piece| piece.0 > 0)).collect();
        Self { text, span, quoted: self.quoted, pieces }
    }

    fn place(&self, offset: usize) -> usize {
        let piece = self.pieces.iter().rev().find(|piece| piece.0 <= offset);
        piece.map_or(self.span.start, |piece| piece.1 + (offset - piece.0))
    }
}

impl std::fmt::Display for SourceText {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_after_a_comment_has_its_location_in_the_program() {
        // "ab;c⏎d" : the text is `ab⏎d`
        let text = SourceText::read("ab\nd".into(), Span::new(0, 8), true, vec![(0, 1), (2, 5)]);
        assert_eq!(text.locate(Span::new(0, 2)), Span::new(1, 3));
        assert_eq!(text.locate(Span::new(3, 4)), Span::new(6, 7));
        assert_eq!(text.part(1..4).locate(Span::new(2, 3)), Span::new(6, 7));
    }
}
