//! The state of reading, and its diagnostics.

use super::super::lex::{Lexer, UnexpectedEnd};
use super::super::limits::MAX_ERRORS;
use super::super::text::SourceText;
use crate::diagnostic::Diagnostic;
use crate::dialect::{Dialect, TextDeviation};
use crate::span::Span;

/// The cues of the sections in their order.
pub(super) const CUES: [&str; 6] =
    ["VARIABLES:", "VARY:", "INTEGRALS:", "OUTPUTS:", "FILES:", "COLOR:"];

/// Reading has ended; the reason is among the diagnostics.
pub(super) struct Fatal;

pub(super) type ParseResult<T> = Result<T, Fatal>;

pub(super) struct Parser<'t> {
    pub(super) text: &'t str,
    pub(super) dialect: Dialect,
    pub(super) reader: Lexer<'t>,
    pub(super) found: Vec<Diagnostic>,
    /// A section cue that was read as something else, and the cue of its section. If reading fails
    /// later, an END is missing before it.
    pub(super) swallowed_cue: Option<(Span, Span)>,
    /// True if sections between VARIABLES and COLOR may be left out.
    pub(super) may_leave_out: bool,
    /// True after a section that could not be read.
    pub(super) has_failed: bool,
    /// True if no further section can be found.
    pub(super) has_ended: bool,
}

impl<'t> Parser<'t> {
    pub(super) fn new(text: &'t str, dialect: Dialect) -> Self {
        Self {
            text,
            dialect,
            reader: Lexer::new(text),
            found: Vec::new(),
            swallowed_cue: None,
            may_leave_out: !dialect.is_compat() && has_colour(text),
            has_failed: false,
            has_ended: false,
        }
    }

    /// Reads a section with `read`. After an error in it the next section that can be found is
    /// read, so that its errors are reported, too; with NIST's dialect reading ends.
    pub(super) fn section<T: Default>(
        &mut self,
        read: impl FnOnce(&mut Self) -> ParseResult<T>,
    ) -> T {
        if self.has_ended {
            return T::default();
        }
        read(self).unwrap_or_else(|Fatal| {
            self.has_failed = true;
            self.has_ended = self.dialect.is_compat() || !self.skip_to_cue();
            T::default()
        })
    }

    /// Moves to the next cue of a section; false if there is none, or the list of errors is full.
    fn skip_to_cue(&mut self) -> bool {
        if self.check_error_limit().is_err() {
            return false;
        }
        if let Some((cue, _)) = self.swallowed_cue.take() {
            self.reader.go_to(cue.start);
            return true;
        }
        while let Ok(token) = self.reader.token() {
            if !token.text.is_quoted() && CUES.iter().any(|cue| is(&token.text, cue)) {
                self.reader.go_to(token.text.span().start);
                return true;
            }
        }
        false
    }

    /// Ends the reading when the list of errors is full.
    pub(super) fn check_error_limit(&self) -> ParseResult<()> {
        if self.found.len() < MAX_ERRORS { Ok(()) } else { Err(Fatal) }
    }

    /// Records a section cue inside a section: an END is missing before it.
    pub(super) fn note_swallowed_cue(&mut self, text: &SourceText, cue: Span) -> ParseResult<()> {
        if text.is_quoted() || !CUES.iter().any(|known| is(text, known)) {
            return Ok(());
        }
        self.swallowed_cue.get_or_insert((text.span(), cue));
        if self.dialect.is_compat() { Ok(()) } else { self.fatal_missing_end() }
    }

    pub(super) fn fatal_missing_end<T>(&mut self) -> ParseResult<T> {
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

    pub(super) fn refuse_junk(&mut self, name: &SourceText, junk: Span) {
        if !TextDeviation::JunkBeforeEquals.refused_in(self.dialect) {
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

    /// Refuses a deviation of NIST's program, if the dialect does.
    pub(super) fn refuse(&mut self, deviation: TextDeviation, span: Span) {
        if !deviation.refused_in(self.dialect) {
            return;
        }
        let (code, message, help, note) = match deviation {
            TextDeviation::EqualsBeforeName => (
                "program/equals-before-name",
                "an equal sign without a name before it",
                "write `name = value`; a value with `=` or blanks needs quotes",
                "NIST's program skips equal signs before a name",
            ),
            TextDeviation::EqualsBeginsValue => (
                "program/double-equals",
                "the value begins with an equal sign",
                "write one `=`",
                "NIST's program takes the second `=` into the value",
            ),
            TextDeviation::EmptyValue => (
                "program/empty-value",
                "the value is missing",
                "write a value, or \"\" for an empty one",
                "NIST's program takes the next word as the value, whatever it is",
            ),
            TextDeviation::CommentInQuotes => (
                "program/comment-in-quotes",
                "a semicolon inside quotes begins a comment",
                "leave out the semicolon, or close the quotes before it",
                "NIST's program drops the rest of the line and goes on with the string in the next",
            ),
            _ => (
                "program/number",
                "this is not a number",
                "write the number alone",
                "NIST's program reads the digits and drops the rest",
            ),
        };
        self.found.push(Diagnostic::error(code, span, message).help(help).note(note));
    }

    /// Reading ended inside a section or value that begins at `cue`.
    pub(super) fn stopped<T>(&mut self, stop: UnexpectedEnd, cue: Span) -> ParseResult<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        let waits = "NIST's program waits here forever";
        let found = match stop {
            UnexpectedEnd::End => {
                let message = format!("no END closes `{}`", cue.of(self.text));
                Diagnostic::error("program/missing-end", cue, message)
                    .help("write END behind the last entry")
                    .note_at(Span::empty(self.text.trim_end().len()), "the text ends here")
            }
            UnexpectedEnd::OpenQuote(quote) => {
                Diagnostic::error("program/open-quote", quote, "these quotes are never closed")
                    .help("write the closing quotes")
            }
            UnexpectedEnd::OpenComment(comment) => {
                let message = "a comment in the last line, which has no line end";
                Diagnostic::error("program/open-comment", comment, message)
                    .help("end the section with END before it, and the file with a line end")
            }
        };
        self.fatal(found.note(waits))
    }

    /// Reading ended where a section should begin.
    pub(super) fn stopped_before<T>(
        &mut self,
        stop: UnexpectedEnd,
        wanted: &str,
    ) -> ParseResult<T> {
        if stop != UnexpectedEnd::End {
            return self.stopped(stop, Span::empty(self.text.len()));
        }
        let message = format!("missing {wanted} section cue, the text ends");
        let end = Span::empty(self.text.trim_end().len());
        let found = Diagnostic::error("program/section-cue", end, message);
        self.fatal(found.help(format!("write {wanted} and END; a section may be empty")))
    }

    pub(super) fn fatal<T>(&mut self, found: Diagnostic) -> ParseResult<T> {
        if self.swallowed_cue.is_some() {
            return self.fatal_missing_end();
        }
        self.found.push(found);
        Err(Fatal)
    }
}

/// True if the text has the cue of COLOR outside of comments.
fn has_colour(text: &str) -> bool {
    let code = |line: &'_ str| line.split(';').next().unwrap_or_default().to_ascii_uppercase();
    text.lines().any(|line| code(line).split_ascii_whitespace().any(|word| word == CUES[5]))
}

pub(super) fn is(text: &SourceText, word: &str) -> bool {
    text.as_str().eq_ignore_ascii_case(word)
}
