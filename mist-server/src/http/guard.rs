//! The middleware of every request: its number, its key, its line in the log.

use std::{
    net::IpAddr,
    sync::atomic::{AtomicU64, Ordering},
    time::Instant,
};

use axum::{
    extract::{ConnectInfo, FromRequestParts, MatchedPath, Request, State},
    http::{HeaderValue, Method, header, request::Parts},
    middleware::Next,
    response::{IntoResponse, Response},
};

use super::{error::ApiError, listen::PeerAddress, state::App};
use crate::keys::KeyScope;
use crate::memory::Reservation;

/// The header with the number of a request.
const REQUEST_ID: &str = "x-request-id";
/// Characters of a number that a client or a proxy gives.
const LONGEST_ID: usize = 128;

/// The client: the name of a key, or an address.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Client(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for Client {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ApiError> {
        let own = parts.extensions.get::<Self>().cloned();
        Ok(own.unwrap_or_else(|| Self("unknown".into())))
    }
}

/// Addresses that need no key: they tell whether the service is there, and what it can do.
const OPEN: [&str; 5] = ["/healthz", "/readyz", "/openapi.json", "/docs", "/"];

/// Bodies up to so many bytes are not worth counting.
const SMALL_BODY: usize = 64 << 10;
/// Bytes that a byte of a body needs: as it came, as text, and as what is read from it.
const PER_BYTE: f64 = 3.0;

/// Checks the key, numbers the request, and tells the log how it ended.
pub(super) async fn guard(State(app): State<App>, mut request: Request, next: Next) -> Response {
    let begun = Instant::now();
    let id = request_id(&request);
    let (method, uri) = (request.method().clone(), request.uri().clone());
    let route = request.extensions().get::<MatchedPath>().cloned();
    let mut client = String::new();
    let admitted =
        admit(&app, &request).and_then(|client| Ok((client, reserve_body(&app, &request)?)));
    let mut response = match admitted {
        Ok((found, _held)) => {
            client.clone_from(&found.0);
            request.extensions_mut().insert(found);
            next.run(request).await
        }
        Err(error) => error.into_response(),
    };
    let (status, seconds) = (response.status().as_u16(), begun.elapsed().as_secs_f64());
    tracing::info!(id, %method, path = uri.path(), status, seconds, client, "answered");
    let route = route.as_ref().map_or("none", MatchedPath::as_str);
    app.metrics.count_request(method.as_str(), route, status, seconds);
    if let Ok(id) = HeaderValue::from_str(&id) {
        response.headers_mut().insert(REQUEST_ID, id);
    }
    response
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

/// The client, if it may send the request.
fn admit(app: &App, request: &Request) -> Result<Client, ApiError> {
    let peer = request.extensions().get::<ConnectInfo<PeerAddress>>().map(|info| info.0.0);
    let address = peer.map_or_else(|| "local".to_owned(), |ip: IpAddr| ip.to_string());
    let Some(keys) = &app.keys else { return Ok(Client(address)) };
    let path = request.uri().path();
    if OPEN.contains(&path) || path.starts_with("/docs/") || path.starts_with("/page/") {
        return Ok(Client(address));
    }
    let scope = match *request.method() {
        Method::GET | Method::HEAD => KeyScope::Read,
        _ => KeyScope::Run,
    };
    let given = request.headers().get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
    let key = given.and_then(|value| value.split_once(' '));
    let key = key.filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"));
    let (_, key) = key.ok_or(ApiError::Key)?;
    match keys.check(key.trim(), scope) {
        Some((name, true)) => Ok(Client(name.to_owned())),
        Some((_, false)) => Err(ApiError::Scope(scope.name())),
        None => Err(ApiError::Key),
    }
}
