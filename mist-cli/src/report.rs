//! Diagnostics for people and for editors.

use std::io::{IsTerminal, Write};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use mist_format::{Diagnostic, LineIndex, Severity, Span};
use serde_json::{Value, json};

/// Excerpts longer than this are not shown: a program on one line of a megabyte helps no one.
const EXCERPT_BYTES: usize = 2000;

/// Form of diagnostics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum MessageFormat {
    /// Text with an excerpt, on standard error.
    #[default]
    Human,
    /// One JSON object per line, on standard output.
    Json,
}

/// A message, and its help on a line of its own.
pub(crate) fn with_help(message: &str, help: Option<&str>) -> String {
    help.map_or_else(|| message.to_owned(), |help| format!("{message}\n  help: {help}"))
}

/// Prints a line on standard error.
pub(crate) fn print_line(line: &str) {
    // Nobody can be told that standard error is closed.
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Prints the diagnostics about the text `source` of the file `file`.
pub(crate) fn print_diagnostics<'a>(
    diagnostics: impl IntoIterator<Item = &'a Diagnostic>,
    file: &str,
    source: &str,
    format: MessageFormat,
) {
    let lines = LineIndex::new(source);
    for diagnostic in diagnostics {
        match format {
            MessageFormat::Human => {
                let styled =
                    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
                print_line(&human(diagnostic, file, source, &lines, styled));
            }
            MessageFormat::Json => {
                let line = to_json(diagnostic, file, source, &lines);
                // Nobody can be told that standard output is closed.
                let _ = writeln!(std::io::stdout().lock(), "{line}");
            }
        }
    }
}

/// One diagnostic as a terminal shows it.
fn human(
    diagnostic: &Diagnostic,
    file: &str,
    source: &str,
    lines: &LineIndex,
    styled: bool,
) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code);
    let mut main = Group::with_title(title);
    let excerpt = Excerpt::around(diagnostic, source, lines);
    main = match &excerpt {
        Some(excerpt) => main.element(excerpt.snippet(diagnostic, file)),
        None => {
            let at = lines.location(source, diagnostic.span.start);
            let origin = annotate_snippets::Origin::path(file).line(at.line).char_column(at.column);
            main.element(origin)
        }
    };
    for note in diagnostic.notes.iter().filter(|note| note.span.is_none()) {
        main = main.element(Level::NOTE.message(note.message.as_str()));
    }
    if let Some(help) = &diagnostic.help {
        main = main.element(Level::HELP.message(help.as_str()));
    }
    let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[main])
}

/// The whole lines that a diagnostic and its notes touch.
struct Excerpt<'a> {
    text: &'a str,
    start: usize,
    line: usize,
}

impl<'a> Excerpt<'a> {
    fn around(diagnostic: &Diagnostic, source: &'a str, lines: &LineIndex) -> Option<Self> {
        let notes = diagnostic.notes.iter().filter_map(|note| note.span);
        let spans: Vec<Span> = std::iter::once(diagnostic.span).chain(notes).collect();
        let first = spans.iter().map(|span| span.start).min()?.min(source.len());
        let last = spans.iter().map(|span| span.end).max()?.clamp(first, source.len());
        let bytes = source.as_bytes();
        let start = bytes[..first].iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
        let rest = bytes[last..].iter().position(|b| *b == b'\n');
        let end = rest.map_or(source.len(), |at| last + at);
        let text = source.get(start..end).filter(|text| text.len() <= EXCERPT_BYTES)?;
        Some(Self { text, start, line: lines.line(start) })
    }

    fn snippet(
        &self,
        diagnostic: &'a Diagnostic,
        file: &'a str,
    ) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
        let primary = AnnotationKind::Primary.span(self.range(diagnostic.span));
        let notes = diagnostic.notes.iter().filter_map(|note| {
            let range = self.range(note.span?);
            Some(AnnotationKind::Context.span(range).label(note.message.as_str()))
        });
        Snippet::source(self.text)
            .line_start(self.line)
            .path(file)
            .annotation(primary)
            .annotations(notes)
    }

    /// The bytes of the excerpt that `span` covers, on character boundaries.
    fn range(&self, span: Span) -> std::ops::Range<usize> {
        let inside = |at: usize| boundary(self.text, at.saturating_sub(self.start));
        let start = inside(span.start);
        start..inside(span.end).max(start)
    }
}

/// The last place at or before `at` where a character of `text` begins.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// One diagnostic for an editor.
fn to_json(diagnostic: &Diagnostic, file: &str, source: &str, lines: &LineIndex) -> Value {
    let place = |span: Span| {
        let (start, end) = (lines.location(source, span.start), lines.location(source, span.end));
        json!({
            "span": [span.start, span.end],
            "line": start.line,
            "column": start.column,
            "end_line": end.line,
            "end_column": end.column,
        })
    };
    let notes = diagnostic
        .notes
        .iter()
        .map(|note| json!({ "message": note.message, "place": note.span.map(place) }));
    let mut value = place(diagnostic.span);
    value["file"] = json!(file);
    value["code"] = json!(diagnostic.code);
    value["severity"] = json!(diagnostic.severity);
    value["message"] = json!(diagnostic.message);
    value["help"] = json!(diagnostic.help);
    value["notes"] = notes.collect();
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "MODEL = Facet\nVARIABLES:\n  a = 2*(x + 1\nEND\n";

    fn unclosed() -> Diagnostic {
        let at = SOURCE.find('(').unwrap();
        Diagnostic::error("expr/unclosed", Span::new(at, at + 1), "this is never closed")
            .help("write `)`")
            .note("NIST's program ends the expression here")
    }

    #[test]
    fn people_see_file_line_column_excerpt_and_help() {
        let text = human(&unclosed(), "scan.mist", SOURCE, &LineIndex::new(SOURCE), false);
        for part in ["error[expr/unclosed]", "scan.mist:3:9", "a = 2*(x + 1", "^", "write `)`"] {
            assert!(text.contains(part), "{part:?} in\n{text}");
        }
    }

    #[test]
    fn editors_get_the_same_as_json() {
        let value = to_json(&unclosed(), "scan.mist", SOURCE, &LineIndex::new(SOURCE));
        assert_eq!((&value["line"], &value["column"]), (&json!(3), &json!(9)));
        assert_eq!(value["severity"], "error");
        assert_eq!(value["help"], "write `)`");
    }

    #[test]
    fn a_place_at_the_end_or_in_an_endless_line_is_still_told() {
        let long = "x".repeat(1_000_000);
        for (source, span) in [
            ("", Span::empty(0)),
            ("a\n", Span::empty(2)),
            ("µ", Span::new(1, 2)),
            (long.as_str(), Span::new(500_000, 500_001)),
        ] {
            let diagnostic = Diagnostic::error("a/b", span, "wrong");
            let text = human(&diagnostic, "f", source, &LineIndex::new(source), false);
            assert!(text.contains("wrong") && text.contains("f:"), "{text}");
            assert!(text.len() < 10_000);
        }
    }
}
