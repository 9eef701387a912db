//! The middleware of every request: its origin, its number, its key, its line in the log.

use std::{
    sync::atomic::{AtomicU64, Ordering},
    time::Instant,
};

use axum::{
    extract::{MatchedPath, Request, State},
    http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header},
    middleware::Next,
    response::{IntoResponse, Response},
};

use super::{admission, error::ApiError, page, state::App};
use crate::memory::HeldMemory;

/// The header with the number of a request.
const REQUEST_ID: &str = "x-request-id";
/// Characters of a number that a client or a proxy gives.
const LONGEST_ID: usize = 128;

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
        Ok(client)
    });
    let (mut response, client) = match admitted {
        Ok(client) => {
            let name = client.name.clone();
            let held = HeldMemory::default();
            request.extensions_mut().insert(client);
            request.extensions_mut().insert(held.clone());
            let response = next.run(request).await;
            drop(held);
            (response, name)
        }
        Err(error) => {
            if matches!(error, ApiError::Key) {
                tracing::warn!(address, %method, path = uri.path(), "no key, or a wrong one");
                tokio::time::sleep(app.failed_keys.count(&address)).await;
            }
            (error.into_response(), address)
        }
    };
    if method == Method::OPTIONS && response.status() == StatusCode::METHOD_NOT_ALLOWED {
        // The header `Allow` is there already.
        let allow = response.headers().get(header::ALLOW).cloned();
        response = StatusCode::NO_CONTENT.into_response();
        response.headers_mut().extend(allow.map(|allow| (header::ALLOW, allow)));
    }
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

/// The number that the client or a proxy gave, or the next one.
fn request_id(request: &Request) -> String {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    let given = request.headers().get(REQUEST_ID).and_then(|id| id.to_str().ok());
    match given.filter(|id| !id.is_empty() && id.len() <= LONGEST_ID) {
        Some(id) => id.to_owned(),
        None => NEXT.fetch_add(1, Ordering::Relaxed).to_string(),
    }
}
