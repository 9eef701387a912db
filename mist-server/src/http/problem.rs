//! The JSON of errors, and their description in the API (RFC 9457).

use std::collections::BTreeMap;

use axum::http::StatusCode;
use serde::Serialize;
use utoipa::{
    IntoResponses, ToSchema,
    openapi::{
        Ref, RefOr,
        content::ContentBuilder,
        response::{Response, ResponseBuilder},
    },
};

use crate::failure::{FailureReport, LocatedDiagnostic};

/// The reason why a request was not answered.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Problem {
    /// Kind of problem as a URI (RFC 9457); `code` says it more exactly.
    #[serde(rename = "type")]
    #[schema(example = "about:blank")]
    kind: &'static str,
    /// The meaning of the status.
    pub(super) title: String,
    /// The status of the answer.
    pub(super) status: u16,
    /// Kind of problem; stable.
    pub(super) code: String,
    /// The message for people (RFC 9457).
    detail: String,
    /// The same message.
    pub(super) message: String,
    /// The parameter or the part of the request at fault.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) part: Option<String>,
    /// Line of the program, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) line: Option<usize>,
    /// Column of the program, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) column: Option<usize>,
    /// A remedy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) help: Option<String>,
    /// The flag of `mist serve` whose limit was reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) limit: Option<String>,
    /// All diagnostics of the program.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) diagnostics: Vec<LocatedDiagnostic>,
}

impl Problem {
    /// A problem that has a message alone.
    pub(super) fn new(status: StatusCode, code: &str, message: impl Into<String>) -> Self {
        Self::of(status, FailureReport::new(code, message))
    }

    /// A reported failure with the status of its answer.
    pub(super) fn of(status: StatusCode, report: FailureReport) -> Self {
        let FailureReport { code, message, part, line, column, help, limit, diagnostics } = report;
        let title = status.canonical_reason().unwrap_or("Error").to_owned();
        let status = status.as_u16();
        Self {
            kind: "about:blank",
            title,
            status,
            code,
            detail: message.clone(),
            message,
            part,
            line,
            column,
            help,
            limit,
            diagnostics,
        }
    }
}

/// The problems that every address may answer with.
pub(super) struct Problems;

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
            ("412", "The content is not the one that If-Match names"),
            ("413", "The body is larger than the service allows"),
            ("415", "The body is of a kind that is not read here"),
            ("422", "The request is understood, but wrong: a value, a program, or a limit"),
            ("429", "The client has too many jobs; Retry-After says when to ask again"),
            ("500", "The service has failed; its log has more"),
            ("503", "The service has too much to do, or is stopping; see Retry-After"),
            ("507", "The store cannot be written"),
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
