//! Warnings of answers: the key `warnings` of JSON, the header `Mist-Warning` of everything.

use axum::{
    http::{HeaderName, HeaderValue},
    response::Response,
};
use mist_engine::Warning;

use crate::failure::LocatedDiagnostic;

/// Header with one warning; there may be several.
const HEADER: HeaderName = HeaderName::from_static("mist-warning");
/// Most headers of one answer.
const MOST: usize = 16;

/// The answer with a header for each of `lines`.
fn with_lines(mut response: Response, lines: impl Iterator<Item = String>) -> Response {
    for line in lines.take(MOST) {
        let ascii: String =
            line.chars().map(|c| if matches!(c, ' '..='~') { c } else { '?' }).collect();
        if let Ok(value) = HeaderValue::from_str(&ascii) {
            response.headers_mut().append(HEADER, value);
        }
    }
    response
}

/// The answer with its warnings in headers.
pub(super) fn with_warnings(response: Response, warnings: &[Warning]) -> Response {
    let line = |w: &Warning| format!("{}: {}", w.code, w.message);
    with_lines(response, warnings.iter().map(line))
}

/// The answer of a program with its warnings in headers.
pub(super) fn with_diagnostics(response: Response, warnings: &[LocatedDiagnostic]) -> Response {
    let line = |w: &LocatedDiagnostic| format!("{}: line {}: {}", w.code, w.line, w.message);
    with_lines(response, warnings.iter().map(line))
}
