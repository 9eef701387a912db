//! One request, and what came back.

use axum::{
    body::{Body, to_bytes},
    http::{HeaderMap, Method, Request, StatusCode, header},
};
use mist_server::http::{App, router};
use serde_json::Value;
use tower::ServiceExt;

/// A rough dielectric.
pub(crate) const GLASS: &str =
    r#"{"model":"Facet_BRDF_Model","parameters":{"substrate":"(1.5,0)","sdf.s":0.3}}"#;

/// The answer.
pub(crate) struct Answer {
    pub(crate) status: StatusCode,
    pub(crate) headers: HeaderMap,
    pub(crate) tag: Option<String>,
    pub(crate) text: String,
}

impl Answer {
    /// The body as JSON.
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.text).unwrap_or_else(|error| panic!("{error}: {}", self.text))
    }
}

/// Sends a text, as JSON if it begins so, and a tag that the client knows.
pub(crate) async fn ask(
    app: &App,
    method: Method,
    uri: &str,
    tag: Option<&str>,
    body: &str,
) -> Answer {
    let kind = if body.starts_with('{') { "application/json" } else { "application/x-mist" };
    let tag = tag.map(|tag| ("if-none-match", tag));
    let headers: Vec<(&str, &str)> = tag.into_iter().chain([("content-type", kind)]).collect();
    let (status, headers, bytes) = send(app, method, uri, &headers, body.to_owned()).await;
    let tag = headers.get(header::ETAG).map(|t| t.to_str().unwrap().to_owned());
    Answer { status, headers, tag, text: String::from_utf8(bytes).unwrap() }
}

/// Sends any body with any headers; without others to `localhost`, a posted body as vectors and
/// another one as JSON.
pub(crate) async fn send(
    app: &App,
    method: Method,
    uri: &str,
    headers: &[(&str, &str)],
    body: impl Into<Body>,
) -> (StatusCode, HeaderMap, Vec<u8>) {
    let usual = match method {
        Method::POST => "application/octet-stream",
        _ => "application/json",
    };
    let mut request = Request::builder().method(method).uri(uri);
    for (name, value) in [("host", "localhost"), ("content-type", usual)] {
        if !headers.iter().any(|(given, _)| *given == name) {
            request = request.header(name, value);
        }
    }
    for (name, value) in headers {
        request = request.header(*name, *value);
    }
    let request = request.body(body.into()).unwrap();
    let response = router(app.clone()).oneshot(request).await.unwrap();
    let (parts, body) = response.into_parts();
    let bytes = to_bytes(body, 1 << 26).await.unwrap();
    (parts.status, parts.headers, bytes.to_vec())
}
