//! Assignments, values and words of a section.

use super::super::lex::{LexedToken, UnexpectedEnd};
use super::super::text::SourceText;
use super::parser::{ParseResult, Parser, is};
use crate::diagnostic::Diagnostic;
use crate::dialect::TextDeviation;
use crate::number::is_blank;
use crate::span::Span;

/// One assignment, or the END of a section.
pub(super) enum Assignment {
    Entry(SourceText, SourceText),
    End(Span),
}

/// The kind of a section's values.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ValueKind {
    Expressions,
    Texts,
}

impl Parser<'_> {
    /// A token inside a section.
    pub(super) fn section_token(&mut self, cue: Span) -> ParseResult<SourceText> {
        self.check_error_limit()?;
        match self.reader.token() {
            Ok(token) => {
                self.note_swallowed_cue(&token.text, cue)?;
                Ok(self.plain(token))
            }
            Err(stop) => self.stopped(stop, cue),
        }
    }

    /// An assignment inside a section.
    pub(super) fn assignment(
        &mut self,
        cue: Span,
        values: impl Fn(&str) -> ValueKind,
    ) -> ParseResult<Assignment> {
        self.check_error_limit()?;
        let name = match self.reader.name() {
            Ok(name) => name,
            Err(stop) => return self.stopped(stop, cue),
        };
        if is(&name.text, "END") {
            return Ok(Assignment::End(name.text.span()));
        }
        self.note_swallowed_cue(&name.text, cue)?;
        if let Some(equals) = name.equals {
            self.refuse(TextDeviation::EqualsBeforeName, equals);
        }
        let value = self.value(&name.text, values(name.text.as_str()))?;
        Ok(Assignment::Entry(name.text, value))
    }

    /// The equal sign after a name, and the value.
    pub(super) fn value(
        &mut self,
        name: &SourceText,
        values: ValueKind,
    ) -> ParseResult<SourceText> {
        match self.reader.equals() {
            Ok(None) => {}
            Ok(Some(junk)) => self.refuse_junk(name, junk),
            Err(UnexpectedEnd::End) => {
                let message =
                    format!("expecting assignment, i.e., variable = value, behind `{name}`");
                let found = Diagnostic::error("program/assignment", name.span(), message);
                return self.fatal(found.help("write `=` and a value, then END"));
            }
            Err(stop) => return self.stopped(stop, name.span()),
        }
        let token = match self.reader.token() {
            Ok(token) => token,
            Err(stop) => return self.stopped(stop, name.span()),
        };
        let value = self.plain(token);
        if value.is_quoted() {
            return Ok(value);
        }
        if value.as_str().starts_with('=') {
            self.refuse(TextDeviation::EqualsBeginsValue, value.span());
            if value.as_str() == "=" && TextDeviation::EqualsBeginsValue.refused_in(self.dialect) {
                return self.section_token(name.span());
            }
        } else if values == ValueKind::Expressions && open_parentheses(value.as_str()) > 0 {
            self.check_blank_in_value(&value);
        } else if is(&value, "END") || self.an_equal_sign_follows() {
            self.refuse(TextDeviation::EmptyValue, name.span().to(value.span()));
            if TextDeviation::EmptyValue.refused_in(self.dialect) {
                // The word is not a value: it is read again as a name or END.
                self.reader.go_to(value.span().start);
            }
        }
        Ok(value)
    }

    /// The value with the following words of its line, up to END or the next assignment.
    pub(super) fn with_words(&mut self, value: SourceText) -> SourceText {
        if value.is_quoted() {
            return value;
        }
        let Span { start, end: first } = value.span();
        let line = &self.text[first..];
        let line = &line[..line.find(['\n', ';']).unwrap_or(line.len())];
        let blank = |c: char| u8::try_from(c).is_ok_and(is_blank);
        let mut end = first;
        let mut at = 0;
        for word in line.split(blank) {
            let behind = line[at + word.len()..].trim_start_matches(blank);
            let is_other = word.eq_ignore_ascii_case("END") || word.contains(['=', '"']);
            if is_other || behind.starts_with('=') {
                break;
            }
            if !word.is_empty() {
                end = first + at + word.len();
            }
            at += word.len() + 1;
        }
        self.reader.go_to(end);
        SourceText::new(&self.text[start..end], start)
    }

    /// `(1, 2)` without quotes: the blank ends the value. NIST's program says `Mismatched
    /// parentheses` when it evaluates it. Reading goes on in the next line.
    pub(super) fn check_blank_in_value(&mut self, value: &SourceText) {
        if value.is_quoted() || open_parentheses(value.as_str()) <= 0 {
            return;
        }
        let rest = self.reader.rest();
        let line = &rest[..rest.find(['\n', ';']).unwrap_or(rest.len())];
        self.found.push(if line.contains(')') {
            let message = "a blank ends this value inside a parenthesis";
            let found = Diagnostic::error("program/blank-in-value", value.span(), message);
            let whole = format!("{value}{}", line.trim_end());
            self.reader.go_to(self.reader.at() + line.len());
            found.help(format!("write it in quotes, `\"{whole}\"`, or without blanks"))
        } else {
            let message = "mismatched parentheses";
            Diagnostic::error("program/parentheses", value.span(), message)
                .help("close the parenthesis; a value with blanks needs quotes")
        });
    }

    /// True if the value just read is the name of the next assignment.
    pub(super) fn an_equal_sign_follows(&self) -> bool {
        self.reader.rest().trim_start_matches([' ', '\t']).starts_with('=')
    }

    /// The text of a token; a comment inside its quotes is refused if the dialect does.
    pub(super) fn plain(&mut self, token: LexedToken) -> SourceText {
        if let Some(comment) = token.comments.first() {
            self.refuse(TextDeviation::CommentInQuotes, *comment);
        }
        token.text
    }
}

/// Opening parentheses without their partner.
pub(super) fn open_parentheses(text: &str) -> isize {
    text.bytes().fold(0, |open, byte| match byte {
        b'(' => open + 1,
        b')' => open - 1,
        _ => open,
    })
}
