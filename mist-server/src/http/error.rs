//! What a request gets instead of its answer: `application/problem+json`.

use axum::{
    Json,
    http::{StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{Failure, material::MaterialError};
use mist_format::{Diagnostic, LineIndex};
use serde_json::json;

use crate::compute::Panicked;

/// Why a request was not answered.
#[derive(Debug)]
pub(crate) enum ApiError {
    /// Nothing has this name.
    NotFound(String),
    /// The query of the URL cannot be read.
    Query(String),
    /// The request is understood, but its material or its query is wrong.
    Material(MaterialError),
    /// The program is wrong: its text and what was found.
    Program(String, Vec<Diagnostic>),
    /// The work failed.
    Failed(String),
}

impl From<MaterialError> for ApiError {
    fn from(error: MaterialError) -> Self {
        Self::Material(error)
    }
}

impl From<Panicked> for ApiError {
    fn from(error: Panicked) -> Self {
        Self::Failed(error.to_string())
    }
}

impl ApiError {
    /// The failure of the program `text`.
    pub(crate) fn of_program(text: &str, failure: Failure) -> Self {
        match failure {
            Failure::Program(found) => Self::Program(text.to_owned(), found),
            other => Self::Failed(other.to_string()),
        }
    }
}

impl IntoResponse for ApiError {
    fn into_response(self) -> Response {
        let (status, body) = match self {
            Self::NotFound(what) => {
                let body = json!({ "code": "not-found", "message": format!("there is no {what}") });
                (StatusCode::NOT_FOUND, body)
            }
            Self::Query(message) => {
                (StatusCode::BAD_REQUEST, json!({ "code": "query", "message": message }))
            }
            Self::Material(error) => {
                let status = match &error {
                    MaterialError::Json(_) => StatusCode::BAD_REQUEST,
                    MaterialError::Cancelled => StatusCode::SERVICE_UNAVAILABLE,
                    _ => StatusCode::UNPROCESSABLE_ENTITY,
                };
                let body = json!({
                    "code": "material",
                    "message": error.to_string(),
                    "part": error.part(),
                    "help": error.help(),
                });
                (status, body)
            }
            Self::Program(text, found) => {
                (StatusCode::UNPROCESSABLE_ENTITY, program(&text, &found))
            }
            Self::Failed(message) => {
                let body = json!({ "code": "failed", "message": message });
                (StatusCode::INTERNAL_SERVER_ERROR, body)
            }
        };
        let kind = [(header::CONTENT_TYPE, "application/problem+json")];
        (status, kind, Json(body)).into_response()
    }
}

/// The first diagnostic at the top, all of them below.
fn program(text: &str, found: &[Diagnostic]) -> serde_json::Value {
    let lines = LineIndex::new(text);
    let all: Vec<_> = found
        .iter()
        .map(|d| {
            let place = lines.place(text, d.span.start);
            json!({
                "code": d.code,
                "message": d.message,
                "line": place.line,
                "column": place.column,
                "help": d.help,
            })
        })
        .collect();
    let mut top = all.first().cloned().unwrap_or_else(|| json!({ "code": "program" }));
    top["diagnostics"] = json!(all);
    top
}
