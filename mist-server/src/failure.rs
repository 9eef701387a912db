//! Reasons why a program, a material or a job has no result, as they are stored and told.

use mist_format::{Diagnostic, LineIndex, Severity};
use serde::{Deserialize, Serialize};

use crate::limits::LimitReached;

/// The reason why something has no result, for people and for programs.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(crate) struct FailureReport {
    /// Kind of failure; stable.
    pub(crate) code: String,
    /// The message for people.
    pub(crate) message: String,
    /// The parameter or the part of the request at fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) part: Option<String>,
    /// Line of the program, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<usize>,
    /// Column of the program, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) column: Option<usize>,
    /// A remedy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) help: Option<String>,
    /// The flag of `mist serve` whose limit was reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) limit: Option<String>,
    /// All diagnostics of the program.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) diagnostics: Vec<LocatedDiagnostic>,
}

/// A diagnostic of a program with lines and columns.
#[derive(Clone, Debug, Deserialize, Serialize, utoipa::ToSchema)]
#[schema(as = Found)]
pub(crate) struct LocatedDiagnostic {
    /// Kind of mistake; stable.
    pub(crate) code: String,
    /// `error` or `warning`.
    pub(crate) severity: String,
    /// The message.
    pub(crate) message: String,
    /// Line of its beginning, from 1.
    pub(crate) line: usize,
    /// Column of its beginning, from 1.
    pub(crate) column: usize,
    /// Line of its end.
    pub(crate) end_line: usize,
    /// Column of its end.
    pub(crate) end_column: usize,
    /// A remedy.
    pub(crate) help: Option<String>,
    /// Notes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) notes: Vec<String>,
}

impl FailureReport {
    /// A report without a place.
    pub(crate) fn new(code: &str, message: impl Into<String>) -> Self {
        Self { code: code.to_owned(), message: message.into(), ..Self::default() }
    }

    /// The report of a limit of the service; its help names the flag.
    pub(crate) fn of_limit(code: &str, limit: LimitReached) -> Self {
        let help = format!("the service was started with --{} {}", limit.flag, limit.value);
        Self {
            limit: Some(limit.flag.to_owned()),
            help: Some(help),
            ..Self::new(code, limit.message)
        }
    }

    /// The diagnostics of the program `text`: the first one at the top, all of them below.
    pub(crate) fn of_diagnostics(text: &str, found: &[Diagnostic]) -> Self {
        let diagnostics = located(text, found);
        let Some(first) = diagnostics.first().cloned() else {
            return Self::new("program", "the program is wrong");
        };
        Self {
            line: Some(first.line),
            column: Some(first.column),
            help: first.help,
            diagnostics,
            ..Self::new(&first.code, first.message)
        }
    }
}

/// The diagnostics of the program `text` with lines and columns.
pub(crate) fn located(text: &str, found: &[Diagnostic]) -> Vec<LocatedDiagnostic> {
    let lines = LineIndex::new(text);
    let one = |d: &Diagnostic| {
        let (start, end) = (lines.location(text, d.span.start), lines.location(text, d.span.end));
        LocatedDiagnostic {
            code: d.code.to_owned(),
            severity: match d.severity {
                Severity::Error => "error".into(),
                Severity::Warning => "warning".into(),
            },
            message: d.message.clone(),
            line: start.line,
            column: start.column,
            end_line: end.line,
            end_column: end.column,
            help: d.help.clone(),
            notes: d.notes.iter().map(|note| note.message.clone()).collect(),
        }
    };
    found.iter().map(one).collect()
}
