//! The client of a request: its name, and the permission that it has.

use std::{
    net::IpAddr,
    num::NonZeroUsize,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use axum::{
    extract::{ConnectInfo, FromRequestParts, MatchedPath, Request},
    http::{Method, StatusCode, header, request::Parts},
};
use lru::LruCache;

use super::{error::ApiError, listen::PeerAddress, problem::Problem, state::App};
use crate::{
    keys::KeyScope,
    limits::{LimitReached, ServeLimits},
};

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

/// The client: the name of a key, or an address.
#[derive(Clone, Debug)]
pub(super) struct Client {
    /// Name of the key, or the address.
    pub(super) name: String,
    /// The permission.
    pub(super) scope: KeyScope,
    /// The limits of its computations.
    pub(super) limits: Arc<ServeLimits>,
}

impl FromRequestParts<App> for Client {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &App) -> Result<Self, ApiError> {
        let own = parts.extensions.get::<Self>().cloned();
        own.ok_or_else(|| ApiError::Failed("the request has no client".into()))
    }
}

impl Client {
    /// The error of work that takes longer than one answer may.
    pub(super) fn too_long(&self) -> ApiError {
        let value = self.limits.max_time;
        let message = format!("the answer takes longer than {value} s");
        ApiError::Limit(LimitReached { flag: "max-time", value, message })
    }

    /// Refuses to change what `owner` has created, unless the client is `owner` or has the scope
    /// `admin`.
    ///
    /// # Errors
    ///
    /// 403.
    pub(super) fn may_change(&self, owner: Option<&str>, what: &str) -> Result<(), ApiError> {
        if self.scope == KeyScope::Admin || owner.is_none_or(|owner| owner == self.name) {
            return Ok(());
        }
        let message = format!("{what} belongs to another client");
        let mut problem = Problem::new(StatusCode::FORBIDDEN, "owner", message);
        problem.help = Some("use another name, or a key with the scope admin".into());
        Err(ApiError::Problem(Box::new(problem)))
    }
}

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

/// Addresses that sent no key or a wrong one, and when they did so last; clones share them.
#[derive(Clone, Debug)]
pub(super) struct FailedKeys(Arc<Mutex<LruCache<String, (u32, Instant)>>>);

/// Number of addresses that are remembered.
const REMEMBERED: NonZeroUsize = NonZeroUsize::new(4096).expect("4096 is not 0");
/// Delay of the second refusal in a row; it grows by as much with each.
const STEP: Duration = Duration::from_millis(100);
/// The delay grows to so many steps.
const MOST_STEPS: u32 = 20;
/// An address without failures for so long starts anew.
const FORGOTTEN: Duration = Duration::from_secs(60);

impl Default for FailedKeys {
    fn default() -> Self {
        Self(Arc::new(Mutex::new(LruCache::new(REMEMBERED))))
    }
}

impl FailedKeys {
    /// Counts a failure of `address`; the time for which its answer is held back.
    pub(super) fn count(&self, address: &str) -> Duration {
        let mut failures = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = failures.get_or_insert_mut(address.to_owned(), || (0, Instant::now()));
        if entry.1.elapsed() > FORGOTTEN {
            entry.0 = 0;
        }
        *entry = (entry.0 + 1, Instant::now());
        STEP * (entry.0 - 1).min(MOST_STEPS)
    }
}
