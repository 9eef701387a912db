//! Refusal of requests that a foreign web page sends through the browser of a user.
//!
//! A page can call any address that its browser reaches. Three headers that a page cannot choose
//! tell its requests apart: `Host` has the name of the page's own server after DNS rebinding,
//! `Origin` names the page, and `Sec-Fetch-Site` says whether it is another site (Fetch Metadata).

use axum::{
    extract::Request,
    http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header, uri::Authority},
};
use tower_http::cors::{AllowOrigin, CorsLayer};

use super::{error::ApiError, problem::Problem};
use crate::access::AccessOptions;

const FETCH_SITE: &str = "sec-fetch-site";
const FETCH_MODE: &str = "sec-fetch-mode";

/// Hosts and origins that may use the service, in lower case.
#[derive(Clone, Debug, Default)]
pub(super) struct OriginRules {
    hosts: Vec<String>,
    origins: Vec<String>,
}

impl OriginRules {
    pub(super) fn new(access: &AccessOptions) -> Self {
        let lower = |names: &[String]| names.iter().map(|name| name.to_ascii_lowercase()).collect();
        Self { hosts: lower(&access.hosts), origins: lower(&access.origins) }
    }

    /// Refuses a request for another host, or of a page of another origin.
    ///
    /// # Errors
    ///
    /// 400 without a `Host` or with two of them, else 403.
    pub(super) fn check(&self, request: &Request) -> Result<(), ApiError> {
        let headers = request.headers();
        let host = host(headers)?;
        for authority in [Some(&host), request.uri().authority()].into_iter().flatten() {
            if !self.is_own(authority) {
                let message = format!("this service is not {:?}", authority.host());
                let remedy = "call it by a loopback name, or start it with `--host NAME`";
                return Err(refused("host", message, remedy));
            }
        }
        let remedy = "start the service with `--cors ORIGIN` to let pages of this origin in";
        match header(headers, &header::ORIGIN) {
            Some(origin) if self.allows(origin, &host) => Ok(()),
            Some(origin) => {
                let message = format!("pages of the origin {origin:?} may not use this service");
                Err(refused("origin", message, remedy))
            }
            None if is_foreign(headers) && !is_link_to_page(request) => {
                let message = "pages of other sites may not use this service";
                Err(refused("origin", message, remedy))
            }
            None => Ok(()),
        }
    }

    /// The headers by which browsers let pages of the allowed origins read answers.
    pub(super) fn cors(&self) -> Option<CorsLayer> {
        let origins: Vec<HeaderValue> =
            self.origins.iter().filter_map(|origin| HeaderValue::from_str(origin).ok()).collect();
        let accepted = [
            header::ACCEPT,
            header::AUTHORIZATION,
            header::CONTENT_TYPE,
            header::IF_MATCH,
            header::IF_NONE_MATCH,
            HeaderName::from_static("idempotency-key"),
            HeaderName::from_static("prefer"),
        ];
        (!origins.is_empty()).then(|| {
            CorsLayer::new()
                .allow_origin(AllowOrigin::list(origins))
                .allow_methods([Method::GET, Method::POST, Method::PUT, Method::DELETE])
                .allow_headers(accepted)
                .expose_headers([header::ETAG, header::LOCATION, header::RETRY_AFTER])
        })
    }

    /// True for loopback names and the names of `--host`; the port does not matter.
    fn is_own(&self, authority: &Authority) -> bool {
        let host = authority.host().to_ascii_lowercase();
        let bare = host.trim_start_matches('[').trim_end_matches(']');
        let is_loopback = bare.parse().is_ok_and(|ip: std::net::IpAddr| ip.is_loopback());
        let is_named = self.hosts.iter().any(|own| *own == host || *own == bare);
        host == "localhost" || is_loopback || is_named
    }

    /// True for the origin of the service itself, and for the origins of `--cors`.
    fn allows(&self, origin: &str, host: &Authority) -> bool {
        let origin = origin.to_ascii_lowercase();
        let own = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
        own.is_some_and(|own| own.eq_ignore_ascii_case(host.as_str()))
            || self.origins.contains(&origin)
    }
}

/// The one `Host` of a request.
fn host(headers: &HeaderMap) -> Result<Authority, ApiError> {
    let mut hosts = headers.get_all(header::HOST).iter();
    let (Some(host), None) = (hosts.next(), hosts.next()) else {
        return Err(ApiError::Query("the header Host is missing or doubled".into()));
    };
    let read = host.to_str().ok().filter(|host| !host.contains('@'));
    let read = read.and_then(|host| host.parse().ok());
    read.ok_or_else(|| ApiError::Query("the header Host is not a host".into()))
}

fn header<'a>(headers: &'a HeaderMap, name: &HeaderName) -> Option<&'a str> {
    headers.get(name).map(|value| value.to_str().unwrap_or("null"))
}

/// True if the browser says that a page of another site sends the request.
fn is_foreign(headers: &HeaderMap) -> bool {
    let site = headers.get(FETCH_SITE).and_then(|site| site.to_str().ok());
    matches!(site, Some("cross-site" | "same-site"))
}

/// True if a user follows a link to the page of the service, which neither computes nor stores.
fn is_link_to_page(request: &Request) -> bool {
    let navigates = request.headers().get(FETCH_MODE).is_some_and(|mode| mode == "navigate");
    let is_read = [Method::GET, Method::HEAD].contains(request.method());
    navigates && is_read && matches!(request.uri().path(), "/" | "/docs" | "/docs/")
}

fn refused(code: &str, message: impl Into<String>, remedy: &str) -> ApiError {
    let mut problem = Problem::new(StatusCode::FORBIDDEN, code, message);
    problem.help = Some(remedy.to_owned());
    ApiError::Problem(Box::new(problem))
}
