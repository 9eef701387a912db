//! The JSON of errors, and how the API describes them (RFC 9457).

use std::collections::BTreeMap;

use axum::http::StatusCode;
use mist_format::{Diagnostic, LineIndex};
use serde::{Deserialize, Serialize};
use utoipa::{
    IntoResponses, ToSchema,
    openapi::{
        Ref, RefOr,
        content::ContentBuilder,
        response::{Response, ResponseBuilder},
    },
};

/// Why a request was not answered.
#[derive(Clone, Debug, Deserialize, Serialize, ToSchema)]
pub(crate) struct Problem {
    /// The meaning of the status.
    pub(crate) title: String,
    /// The status of the answer.
    pub(crate) status: u16,
    /// What kind of problem it is; stable.
    pub(crate) code: String,
    /// What is wrong, for people.
    pub(crate) message: String,
    /// The parameter or the part of the request at fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) part: Option<String>,
    /// The line of the program, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) line: Option<usize>,
    /// The column of the program, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) column: Option<usize>,
    /// What to try.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) help: Option<String>,
    /// The flag of `mist serve` whose limit was reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) limit: Option<String>,
    /// Everything that is wrong with the program.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) diagnostics: Vec<Found>,
}

/// One thing that is wrong with a program.
#[derive(Clone, Debug, Deserialize, Serialize, ToSchema)]
pub(crate) struct Found {
    /// What kind of mistake it is; stable.
    pub(crate) code: String,
    /// `error` or `warning`.
    pub(crate) severity: String,
    /// What is wrong.
    pub(crate) message: String,
    /// Where it begins, from 1.
    pub(crate) line: usize,
    /// Where it begins, from 1.
    pub(crate) column: usize,
    /// Where it ends.
    pub(crate) end_line: usize,
    /// Where it ends.
    pub(crate) end_column: usize,
    /// What to try.
    pub(crate) help: Option<String>,
    /// What else is known about it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) notes: Vec<String>,
}

impl Problem {
    /// A problem without a place.
    pub(crate) fn new(status: StatusCode, code: &str, message: impl Into<String>) -> Self {
        Self {
            title: status.canonical_reason().unwrap_or("Error").to_owned(),
            status: status.as_u16(),
            code: code.to_owned(),
            message: message.into(),
            part: None,
            line: None,
            column: None,
            help: None,
            limit: None,
            diagnostics: Vec::new(),
        }
    }
}

/// What was found in the program `text`: the first mistake at the top, all of them below.
pub(crate) fn of_program(text: &str, found: &[Diagnostic]) -> Problem {
    let diagnostics = diagnostics(text, found);
    let status = StatusCode::UNPROCESSABLE_ENTITY;
    let Some(first) = diagnostics.first() else {
        return Problem::new(status, "program", "the program is wrong");
    };
    Problem {
        line: Some(first.line),
        column: Some(first.column),
        help: first.help.clone(),
        diagnostics: diagnostics.clone(),
        ..Problem::new(status, &first.code, &first.message)
    }
}

/// What was found in the program `text`, with lines and columns.
pub(crate) fn diagnostics(text: &str, found: &[Diagnostic]) -> Vec<Found> {
    let lines = LineIndex::new(text);
    let one = |d: &Diagnostic| {
        let (start, end) = (lines.location(text, d.span.start), lines.location(text, d.span.end));
        Found {
            code: d.code.to_owned(),
            severity: match d.severity {
                mist_format::Severity::Error => "error".into(),
                mist_format::Severity::Warning => "warning".into(),
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

/// The problems that every address may answer with.
pub(crate) struct Problems;

impl IntoResponses for Problems {
    fn responses() -> BTreeMap<String, RefOr<Response>> {
        let each = [
            ("400", "The request cannot be read"),
            ("401", "The service has keys, and this one is not known"),
            ("403", "The key has no scope for this"),
            ("404", "There is nothing of this name"),
            ("405", "This address has no such method"),
            ("408", "The body did not come in time"),
            ("409", "It is not in a state for this"),
            ("413", "The body is larger than the service allows"),
            ("415", "The body is of a kind that is not read here"),
            ("422", "The request is understood, but wrong: a value, a program, or a limit"),
            ("429", "The client has too many jobs; Retry-After says when to ask again"),
            ("503", "The service has too much to do, or is stopping; see Retry-After"),
        ];
        each.map(|(status, meaning)| {
            let schema = Some(Ref::from_schema_name("Problem"));
            let content = ContentBuilder::new().schema(schema).build();
            let response = ResponseBuilder::new()
                .description(meaning)
                .content("application/problem+json", content)
                .build();
            (status.to_owned(), response.into())
        })
        .into()
    }
}
