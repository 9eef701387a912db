//! The middleware of every request: its origin, its number, its key, its line in the log.

use std::{
    sync::atomic::{AtomicU64, Ordering},
    time::Instant,
};

use axum::{
    extract::{MatchedPath, Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, header},
    middleware::Next,
    response::{IntoResponse, Response},
};

use super::{admission, error::ApiError, page, state::App};
use crate::memory::Reservation;

/// The header with the number of a request.
const REQUEST_ID: &str = "x-request-id";
/// Characters of a number that a client or a proxy gives.
const LONGEST_ID: usize = 128;

/// Bodies up to so many bytes are not worth counting.
const SMALL_BODY: usize = 64 << 10;
/// Bytes that a byte of a body needs: as it came, as text, and as what is read from it.
const PER_BYTE: f64 = 3.0;

/// Headers of every answer that has none of its own: browsers take it for what it is called, run
/// nothing in it, and let no other site embed it.
const CLOSED: [(HeaderName, HeaderValue); 4] = [
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    (
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'"),
    ),
    (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        HeaderValue::from_static("same-origin"),
    ),
];

/// Checks origin and key, numbers the request, and tells the log how it ended.
pub(super) async fn guard(State(app): State<App>, mut request: Request, next: Next) -> Response {
    let begun = Instant::now();
    let id = request_id(&request);
    let (method, uri) = (request.method().clone(), request.uri().clone());
    let route = request.extensions().get::<MatchedPath>().cloned();
    let address = admission::address(&app, &request);
    let admitted = app.origins.check(&request).and_then(|()| {
        let client = admission::admit(&app, &request, &address)?;
        Ok((client, reserve_body(&app, &request)?))
    });
    let (mut response, client) = match admitted {
        Ok((client, _held)) => {
            let name = client.name.clone();
            request.extensions_mut().insert(client);
            (next.run(request).await, name)
        }
        Err(error) => {
            if matches!(error, ApiError::Key) {
                tracing::warn!(address, %method, path = uri.path(), "no key, or a wrong one");
                tokio::time::sleep(app.failed_keys.count(&address)).await;
            }
            (error.into_response(), address)
        }
    };
    let (status, seconds) = (response.status().as_u16(), begun.elapsed().as_secs_f64());
    tracing::info!(id, %method, path = uri.path(), status, seconds, client, "answered");
    let route = route.as_ref().map_or("none", MatchedPath::as_str);
    app.metrics.count_request(method.as_str(), route, status, seconds);
    if let Ok(id) = HeaderValue::from_str(&id) {
        response.headers_mut().insert(REQUEST_ID, id);
    }
    close(response.headers_mut(), uri.path());
    response
}

/// Adds the headers of [`CLOSED`].
fn close(headers: &mut HeaderMap, path: &str) {
    if path.starts_with("/docs") {
        let policy = HeaderValue::from_static(page::POLICY);
        headers.insert(header::CONTENT_SECURITY_POLICY, policy);
    }
    for (name, value) in CLOSED {
        headers.entry(name).or_insert(value);
    }
}

/// Memory for the body of a request, until it is answered.
fn reserve_body(app: &App, request: &Request) -> Result<Option<Reservation>, ApiError> {
    let most = app.limits.max_body;
    let bytes = match request.headers().get(header::CONTENT_LENGTH) {
        Some(length) => length.to_str().ok().and_then(|length| length.parse().ok()).unwrap_or(most),
        None if request.headers().contains_key(header::TRANSFER_ENCODING) => most,
        None => 0,
    };
    // A body that is too long is not read.
    if bytes <= SMALL_BODY || bytes > most {
        return Ok(None);
    }
    Ok(Some(app.memory.reserve(bytes as f64 * PER_BYTE)?))
}

/// The number that the client or a proxy gave, or the next one.
fn request_id(request: &Request) -> String {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    let given = request.headers().get(REQUEST_ID).and_then(|id| id.to_str().ok());
    match given.filter(|id| !id.is_empty() && id.len() <= LONGEST_ID) {
        Some(id) => id.to_owned(),
        None => NEXT.fetch_add(1, Ordering::Relaxed).to_string(),
    }
}
