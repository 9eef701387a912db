//! Requests that depend on what the client knows: `If-Match` and `If-None-Match` (RFC 9110, 13.1).

use axum::http::{HeaderMap, StatusCode, header};

use super::{error::ApiError, problem::Problem};

/// Refuses a change unless the content with this `hash`, or its absence, is what the client
/// expects.
///
/// # Errors
///
/// 412 if `If-Match` names other contents, or `If-None-Match: *` finds one.
pub(super) fn check(headers: &HeaderMap, hash: Option<&str>) -> Result<(), ApiError> {
    let tag = hash.map(|hash| format!("\"{hash}\""));
    let expected = headers.contains_key(header::IF_MATCH);
    let is_expected = tag.as_ref().is_some_and(|tag| names(headers, &header::IF_MATCH, tag));
    let is_new = tag.as_ref().is_none_or(|tag| !names(headers, &header::IF_NONE_MATCH, tag));
    if (!expected || is_expected) && is_new {
        return Ok(());
    }
    let message = "the content is not the one that If-Match or If-None-Match expects";
    let problem = Problem::new(StatusCode::PRECONDITION_FAILED, "changed", message);
    Err(ApiError::Problem(Box::new(problem)))
}

/// True if the client has the content with this tag.
pub(super) fn is_known(headers: &HeaderMap, tag: &str) -> bool {
    names(headers, &header::IF_NONE_MATCH, tag)
}

/// True if the header is `*` or a list with this tag, weak or not.
fn names(headers: &HeaderMap, name: &header::HeaderName, tag: &str) -> bool {
    let given = headers.get_all(name).iter().filter_map(|value| value.to_str().ok());
    given
        .flat_map(|list| list.split(','))
        .map(str::trim)
        .any(|one| one == "*" || one.strip_prefix("W/").unwrap_or(one) == tag)
}
