//! Parts of requests for handlers; a part that cannot be read is a problem like any other.

use axum::{
    body::{Body, Bytes, HttpBody},
    extract::{FromRequest, FromRequestParts, Request},
    http::{HeaderMap, Uri, header, request::Parts},
};
use futures_util::StreamExt;
use mist_runner::files::decode;
use serde::de::DeserializeOwned;

use super::{
    error::ApiError,
    media::{JSON, MIST, VECTORS},
    state::App,
};
use crate::{limits::LimitReached, memory::HeldMemory};

/// The named parts of the address.
pub(super) struct PathParameters<T>(pub(super) T);

impl<T: DeserializeOwned + Send, S: Send + Sync> FromRequestParts<S> for PathParameters<T> {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ApiError> {
        let found = axum::extract::Path::<T>::from_request_parts(parts, state).await;
        found.map(|path| Self(path.0)).map_err(|error| ApiError::Query(error.body_text()))
    }
}

/// The query of the address.
pub(super) struct Query<T>(pub(super) T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Query<T> {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ApiError> {
        Self::of(&parts.uri)
    }
}

impl<T: DeserializeOwned> Query<T> {
    /// The query of the address `uri`.
    pub(super) fn of(uri: &Uri) -> Result<Self, ApiError> {
        let found = axum::extract::Query::<T>::try_from_uri(uri);
        found.map(|query| Self(query.0)).map_err(|error| ApiError::Query(error.body_text()))
    }
}

/// Refuses a body of another media type than `expected`: a form of a foreign page can send
/// `text/plain`, `multipart/form-data` and `application/x-www-form-urlencoded`, and nothing else.
fn expect(headers: &HeaderMap, expected: &[&str]) -> Result<String, ApiError> {
    let given = headers.get(header::CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or("");
    let kind = given.split(';').next().unwrap_or("").trim().to_ascii_lowercase();
    if expected.contains(&kind.as_str()) {
        return Ok(kind);
    }
    let what = if kind.is_empty() { "there is no Content-Type" } else { given };
    Err(ApiError::MediaType { message: what.to_owned(), expected: expected.join(" or ") })
}

/// The vectors of a renderer.
pub(super) struct VectorBytes(pub(super) Bytes);

impl FromRequest<App> for VectorBytes {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        expect(request.headers(), &[VECTORS])?;
        let BodyBytes(bytes) = BodyBytes::from_request(request, app).await?;
        Ok(Self(bytes))
    }
}

/// JSON as text.
pub(super) struct JsonText(pub(super) String);

impl FromRequest<App> for JsonText {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        expect(request.headers(), &[JSON])?;
        let BodyBytes(bytes) = BodyBytes::from_request(request, app).await?;
        Ok(Self(decode(bytes.into())))
    }
}

/// JSON, or a text in a form of mist: a program, or rows of patches. It is UTF-8, or else
/// Latin-1, as data files are read.
pub(super) struct MistText {
    pub(super) text: String,
    pub(super) is_json: bool,
}

impl FromRequest<App> for MistText {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        let is_json = expect(request.headers(), &[JSON, MIST])? == JSON;
        let BodyBytes(bytes) = BodyBytes::from_request(request, app).await?;
        Ok(Self { text: decode(bytes.into()), is_json })
    }
}

/// The bytes of the body.
struct BodyBytes(Bytes);

impl FromRequest<App> for BodyBytes {
    type Rejection = ApiError;

    async fn from_request(request: Request, app: &App) -> Result<Self, ApiError> {
        let held = request.extensions().get::<HeldMemory>().cloned().unwrap_or_default();
        let read = read_body(request.into_body(), app, &held);
        let read = tokio::time::timeout(app.limits.silence(), read).await;
        Ok(Self(read.map_err(|_| ApiError::Slow)??))
    }
}

/// Bytes of a body for which memory is reserved at a time.
const PART: usize = 64 << 10;
/// Bytes that a byte of a body needs: as it came, as text, and as what is read from it.
const PER_BYTE: f64 = 3.0;

/// Reads a body, and reserves memory as it arrives: a body that is announced holds none.
async fn read_body(body: Body, app: &App, held: &HeldMemory) -> Result<Bytes, ApiError> {
    let most = app.limits.max_body;
    let too_long = || {
        ApiError::TooLarge(LimitReached {
            flag: "max-body",
            value: most as f64,
            message: format!("the body has more than {most} bytes"),
        })
    };
    if body.size_hint().lower() > most as u64 {
        return Err(too_long());
    }
    let (mut bytes, mut reserved) = (Vec::new(), 0);
    let mut parts = body.into_data_stream();
    while let Some(part) = parts.next().await {
        let part = part.map_err(|error| ApiError::Body(error.to_string()))?;
        if bytes.len() + part.len() > most {
            return Err(too_long());
        }
        bytes.extend_from_slice(&part);
        while reserved < bytes.len() {
            held.add(app.memory.reserve(PART as f64 * PER_BYTE)?);
            reserved += PART;
        }
    }
    Ok(bytes.into())
}

/// The kinds of answer that the header `Accept` prefers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Accept {
    /// Text, or anything.
    Text,
    /// `text/csv`.
    Csv,
    /// `application/json`.
    Json,
}

impl<S: Send + Sync> FromRequestParts<S> for Accept {
    type Rejection = ApiError;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ApiError> {
        let headers = parts.headers.get_all(axum::http::header::ACCEPT).iter();
        let given: Vec<&str> = headers.filter_map(|value| value.to_str().ok()).collect();
        Ok(preferred(&given.join(",")))
    }
}

/// The kind with the highest quality, the first of equals.
fn preferred(header: &str) -> Accept {
    let mut best = (Accept::Text, 0.0);
    for entry in header.split(',') {
        let mut parts = entry.split(';').map(str::trim);
        let kind = match parts.next().unwrap_or("") {
            "application/json" | "application/*" => Accept::Json,
            "text/csv" => Accept::Csv,
            "text/plain" | "text/*" | "*/*" => Accept::Text,
            _ => continue,
        };
        let quality = parts.find_map(|part| part.strip_prefix("q=")?.parse().ok()).unwrap_or(1.0);
        if quality > best.1 {
            best = (kind, quality);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_liked_kind_wins_and_text_is_the_default() {
        for (header, kind) in [
            ("", Accept::Text),
            ("*/*", Accept::Text),
            ("application/json", Accept::Json),
            ("text/csv;q=0.5, application/json;q=0.9", Accept::Json),
            ("text/csv, */*;q=0.1", Accept::Csv),
            ("image/png", Accept::Text),
        ] {
            assert_eq!(preferred(header), kind, "{header}");
        }
    }
}
