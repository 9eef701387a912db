//! The entries of sections: cues, assignments and words, with what is odd about them.

use super::super::Text;
use super::super::lex::{Stop, Token};
use super::{CUES, Fatal, MAX_ERRORS, Parser, Read, is};
use crate::diagnostic::Diagnostic;
use crate::dialect::Quirk;
use crate::number::is_blank;
use crate::span::Span;

/// One assignment, or the END of a section.
pub(super) enum Assignment {
    Entry(Text, Text),
    End(Span),
}

/// What a section's values are.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Values {
    Expressions,
    Texts,
}

impl Parser<'_> {
    /// Enough is enough.
    pub(super) fn check_patience(&self) -> Read<()> {
        if self.found.len() < MAX_ERRORS { Ok(()) } else { Err(Fatal) }
    }

    /// A token inside a section.
    pub(super) fn section_token(&mut self, cue: Span) -> Read<Text> {
        self.check_patience()?;
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
        values: impl Fn(&str) -> Values,
    ) -> Read<Assignment> {
        self.check_patience()?;
        let name = match self.reader.name() {
            Ok(name) => name,
            Err(stop) => return self.stopped(stop, cue),
        };
        if is(&name.text, "END") {
            return Ok(Assignment::End(name.text.span()));
        }
        self.note_swallowed_cue(&name.text, cue)?;
        if let Some(equals) = name.equals {
            self.refuse(Quirk::EqualsBeforeName, equals);
        }
        let value = self.value(&name.text, values(name.text.as_str()))?;
        Ok(Assignment::Entry(name.text, value))
    }

    /// The equal sign behind a name, and the value.
    pub(super) fn value(&mut self, name: &Text, values: Values) -> Read<Text> {
        match self.reader.equals() {
            Ok(None) => {}
            Ok(Some(junk)) => self.refuse_junk(name, junk),
            Err(Stop::End) => {
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
            self.refuse(Quirk::EqualsBeginsValue, value.span());
            if value.as_str() == "=" && Quirk::EqualsBeginsValue.refused_in(self.dialect) {
                return self.section_token(name.span());
            }
        } else if values == Values::Expressions && open_parentheses(value.as_str()) > 0 {
            self.check_blank_in_value(&value);
        } else if is(&value, "END") || self.an_equal_sign_follows() {
            self.refuse(Quirk::EmptyValue, name.span().to(value.span()));
            if Quirk::EmptyValue.refused_in(self.dialect) {
                // What was no value is read again as what it is.
                self.reader.go_to(value.span().start);
            }
        }
        Ok(value)
    }

    /// The value with the words behind it in its line, up to END or the next assignment.
    pub(super) fn with_words(&mut self, value: Text) -> Text {
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
        Text::new(&self.text[start..end], start)
    }

    /// `(1, 2)` without quotes: the blank ends the value. NIST's program says `Mismatched
    /// parentheses` when it evaluates it. Reading goes on in the next line.
    pub(super) fn check_blank_in_value(&mut self, value: &Text) {
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

    /// Whether the value just read is the name of the next assignment.
    pub(super) fn an_equal_sign_follows(&self) -> bool {
        self.reader.rest().trim_start_matches([' ', '\t']).starts_with('=')
    }

    /// The text of a token; a comment inside its quotes is refused where the dialect wants it.
    pub(super) fn plain(&mut self, token: Token) -> Text {
        if let Some(comment) = token.comments.first() {
            self.refuse(Quirk::CommentInQuotes, *comment);
        }
        token.text
    }

    /// Notes a section cue where there should be none: an END is missing before it.
    pub(super) fn note_swallowed_cue(&mut self, text: &Text, cue: Span) -> Read<()> {
        if text.is_quoted() || !CUES.iter().any(|known| is(text, known)) {
            return Ok(());
        }
        self.swallowed_cue.get_or_insert((text.span(), cue));
        if self.dialect.is_compat() { Ok(()) } else { self.fatal_missing_end() }
    }

    pub(super) fn fatal_missing_end<T>(&mut self) -> Read<T> {
        if let Some((swallowed, cue)) = self.swallowed_cue {
            let message = format!("END is missing before `{}`", swallowed.of(self.text));
            self.found.push(
                Diagnostic::error("program/missing-end", swallowed, message)
                    .help("close the section before it with END")
                    .note_at(cue, "it begins here"),
            );
        }
        Err(Fatal)
    }

    pub(super) fn refuse_junk(&mut self, name: &Text, junk: Span) {
        if !Quirk::JunkBeforeEquals.refused_in(self.dialect) {
            return;
        }
        let between = Span::new(name.span().end, junk.start).of(self.text);
        let on_one_line = !between.contains('\n');
        let message = if on_one_line {
            format!("`{name}` is followed by something else than `=`")
        } else {
            format!("`{name}` has no value")
        };
        let span = if on_one_line { junk } else { name.span() };
        self.found.push(
            Diagnostic::error("program/junk-before-equals", span, message)
                .help("write `name = value`; a value with blanks needs quotes")
                .note(format!(
                    "NIST's program ignores everything up to the next `=`, and gives `{name}` the \
                     value behind that"
                )),
        );
    }

    /// Refuses a quirk, if the dialect does.
    pub(super) fn refuse(&mut self, quirk: Quirk, span: Span) {
        if !quirk.refused_in(self.dialect) {
            return;
        }
        let (code, message, help, note) = match quirk {
            Quirk::EqualsBeforeName => (
                "program/equals-before-name",
                "an equal sign without a name before it",
                "write `name = value`; a value with `=` or blanks needs quotes",
                "NIST's program skips equal signs before a name",
            ),
            Quirk::EqualsBeginsValue => (
                "program/double-equals",
                "the value begins with an equal sign",
                "write one `=`",
                "NIST's program takes the second `=` into the value",
            ),
            Quirk::EmptyValue => (
                "program/empty-value",
                "the value is missing",
                "write a value, or \"\" for an empty one",
                "NIST's program takes the next word as the value, whatever it is",
            ),
            Quirk::CommentInQuotes => (
                "program/comment-in-quotes",
                "a semicolon inside quotes begins a comment",
                "leave out the semicolon, or close the quotes before it",
                "NIST's program drops the rest of the line and goes on with the string in the next",
            ),
            _ => (
                "program/number",
                "this is no number",
                "write the number alone",
                "NIST's program reads the digits and drops the rest",
            ),
        };
        self.found.push(Diagnostic::error(code, span, message).help(help).note(note));
    }

    /// Reading ended inside a section or value that begins at `cue`.
    pub(super) fn stopped<T>(&mut self, stop: Stop, cue: Span) -> Read<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        let waits = "NIST's program waits here forever";
        let found = match stop {
            Stop::End => {
                let message = format!("no END closes `{}`", cue.of(self.text));
                Diagnostic::error("program/missing-end", cue, message)
                    .help("write END behind the last entry")
                    .note_at(Span::empty(self.text.trim_end().len()), "the text ends here")
            }
            Stop::OpenQuote(quote) => {
                Diagnostic::error("program/open-quote", quote, "these quotes are never closed")
                    .help("write the closing quotes")
            }
            Stop::OpenComment(comment) => {
                let message = "a comment in the last line, which has no line end";
                Diagnostic::error("program/open-comment", comment, message)
                    .help("end the section with END before it, and the file with a line end")
            }
        };
        self.fatal(found.note(waits))
    }

    /// Reading ended where a section should begin.
    pub(super) fn stopped_before<T>(&mut self, stop: Stop, wanted: &str) -> Read<T> {
        if stop != Stop::End {
            return self.stopped(stop, Span::empty(self.text.len()));
        }
        let message = format!("missing {wanted} section cue, the text ends");
        let end = Span::empty(self.text.trim_end().len());
        let found = Diagnostic::error("program/section-cue", end, message);
        self.fatal(found.help(format!("write {wanted} and END; a section may be empty")))
    }

    pub(super) fn fatal<T>(&mut self, found: Diagnostic) -> Read<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        self.found.push(found);
        Err(Fatal)
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
