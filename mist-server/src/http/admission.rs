//! Finds the client of a request by its key or its address, and what it may do.

use std::net::IpAddr;

use axum::{
    extract::{ConnectInfo, MatchedPath, Request},
    http::{Method, header},
};

use super::{client::Client, error::ApiError, listen::PeerAddress, state::App};
use crate::keys::KeyScope;

/// Addresses that need no key: they tell whether the service is there, and what it can do.
const OPEN: [&str; 5] = ["/healthz", "/readyz", "/openapi.json", "/docs", "/"];
/// Computations that store nothing: a key with the scope `read` may ask for small ones.
const COMPUTATIONS: [&str; 5] = [
    "/v1/check",
    "/v1/color",
    "/v1/evaluate",
    "/v1/materials/{name}/evaluate",
    "/v1/materials/{name}/integrate",
];

/// The address from which a request came: of the connection, or as the proxy says.
pub(super) fn address(app: &App, request: &Request) -> String {
    let forwarded = request.headers().get_all("x-forwarded-for").iter().next_back();
    let last = forwarded.and_then(|list| list.to_str().ok()?.rsplit(',').next());
    let told: Option<IpAddr> = last.and_then(|ip| ip.trim().parse().ok());
    let peer = request.extensions().get::<ConnectInfo<PeerAddress>>().map(|info| info.0.0);
    let address = told.filter(|_| app.access.trust_forwarded_for).or(peer);
    address.map_or_else(|| "local".to_owned(), |ip| ip.to_string())
}

/// The client of a request from `address`, if it may send it.
///
/// # Errors
///
/// 401 without a known key, 403 if the key has no scope for this.
pub(super) fn admit(app: &App, request: &Request, address: &str) -> Result<Client, ApiError> {
    let client = |name: &str, scope| Client {
        name: name.to_owned(),
        scope,
        limits: if scope == KeyScope::Read { &app.read_limits } else { &app.limits }.clone(),
    };
    let Some(keys) = &app.keys else { return Ok(client(address, KeyScope::Admin)) };
    let path = request.uri().path();
    if OPEN.contains(&path) || path.starts_with("/docs/") || path.starts_with("/page/") {
        return Ok(client(address, KeyScope::Read));
    }
    let given = request.headers().get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
    let key = given.and_then(|value| value.split_once(' '));
    let key = key.filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"));
    let (_, key) = key.ok_or(ApiError::Key)?;
    let (name, scope) = keys.find(key.trim()).ok_or(ApiError::Key)?;
    let needed = needed(request);
    if scope < needed { Err(ApiError::Scope(needed.name())) } else { Ok(client(name, scope)) }
}

/// The scope that a request needs.
fn needed(request: &Request) -> KeyScope {
    let route = request.extensions().get::<MatchedPath>().map_or("", MatchedPath::as_str);
    match *request.method() {
        Method::GET | Method::HEAD | Method::OPTIONS => KeyScope::Read,
        Method::POST if COMPUTATIONS.contains(&route) => KeyScope::Read,
        _ => KeyScope::Run,
    }
}
