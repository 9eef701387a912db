//! Files of materials: identified by a tag, computed once for all clients, and kept.

use std::time::Duration;

use axum::{
    body::Bytes,
    http::{HeaderMap, HeaderValue, StatusCode, Uri, header},
    response::{IntoResponse, Response},
};
use mist_engine::Control;
use serde::Serialize;
use sha2::{Digest, Sha256};

use super::{
    client::Client,
    error::ApiError,
    preconditions,
    problem::Problem,
    state::{App, FileProducer},
};
use crate::{compute::WorkSize, memory::Reservation};

/// Seconds that a client waits for a file unless it says otherwise.
const PATIENCE: f64 = 30.0;
/// Seconds after which a client may ask again for a file that is being computed.
const RETRY_AFTER: u32 = 1;

/// A request for a file of a material.
pub(super) struct FileRequest<'a> {
    tag: String,
    kind: &'static str,
    headers: &'a HeaderMap,
    uri: &'a Uri,
    patience: Duration,
}

impl<'a> FileRequest<'a> {
    /// A request for the file that depends on `content` alone, of the media type `kind`, by a
    /// client that waits for `wait` seconds if the query says so.
    pub(super) fn new(
        content: &impl Serialize,
        kind: &'static str,
        wait: Option<f64>,
        (headers, uri): (&'a HeaderMap, &'a Uri),
    ) -> Result<Self, ApiError> {
        let content = serde_json::to_string(content);
        let content = content.map_err(|error| ApiError::Failed(error.to_string()))?;
        let patience = patience(wait, headers);
        Ok(Self { tag: tag_of(&content), kind, headers, uri, patience })
    }

    /// The answer 304 to a client that has the file already.
    pub(super) fn not_modified(&self) -> Option<Response> {
        preconditions::is_known(self.headers, &self.tag)
            .then(|| (StatusCode::NOT_MODIFIED, [(header::ETAG, &self.tag)]).into_response())
    }

    /// The file, or 202 if it takes longer than the client waits. `work` computes it, and needs
    /// about so many `bytes` of memory.
    pub(super) async fn answer(
        self,
        app: &App,
        client: &Client,
        (bytes, size): (f64, WorkSize),
        work: impl FnOnce(&Control) -> Result<Bytes, ApiError> + Send + 'static,
    ) -> Result<Response, ApiError> {
        // A refusal of one client is not shared with others, whose limits may differ.
        let key = format!("{}{}", client.scope.name(), self.tag);
        let (mut subscriber, producer) = app.files.join(&key);
        app.metrics.count_table(producer.is_none());
        if let Some(producer) = producer {
            let held = app.memory.reserve(bytes)?;
            tokio::spawn(compute(app.clone(), client.clone(), producer, size, held, work));
        }
        match subscriber.wait(self.patience).await {
            Some(Ok(file)) => {
                let headers = [(header::CONTENT_TYPE, self.kind)];
                Ok(([(header::ETAG, self.tag)], headers, file).into_response())
            }
            Some(Err(problem)) => Err(ApiError::Problem(Box::new(problem))),
            None => Ok(come_back(self.uri)),
        }
    }
}

/// Computes a file for all clients that wait for it.
async fn compute(
    app: App,
    client: Client,
    producer: FileProducer,
    size: WorkSize,
    held: Reservation,
    work: impl FnOnce(&Control) -> Result<Bytes, ApiError> + Send + 'static,
) {
    let work = move |control: &Control| {
        let _held = held;
        work(control)
    };
    let computed = app.compute_until(&client, size, producer.cancel.clone(), work);
    let computed = tokio::select! {
        computed = computed => computed.and_then(|done| done),
        () = producer.abandoned() => Err(ApiError::Unavailable("nobody asked again".into())),
    };
    let result: Result<Bytes, Problem> = computed.map_err(ApiError::problem);
    let bytes = result.as_ref().map_or(0, Bytes::len);
    // A failure of the service may be over when the next client asks.
    let keep_failure = result.as_ref().is_err_and(|problem| problem.status < 500);
    producer.publish(result, bytes, keep_failure);
}

/// Time for which the client waits: of the query, of the header `Prefer` (RFC 7240), or the default.
fn patience(wait: Option<f64>, headers: &HeaderMap) -> Duration {
    let prefers = headers.get_all("prefer").iter().filter_map(|value| value.to_str().ok());
    let mut preferred = None;
    for preference in prefers.flat_map(|list| list.split([',', ';'])).map(str::trim) {
        if let Some(seconds) = preference.strip_prefix("wait=") {
            preferred = seconds.trim_matches('"').parse().ok();
        } else if preference == "respond-async" && preferred.is_none() {
            preferred = Some(0.0);
        }
    }
    let seconds: f64 = wait.or(preferred).unwrap_or(PATIENCE);
    Duration::try_from_secs_f64(seconds.clamp(0.0, 3600.0)).unwrap_or_default()
}

fn come_back(uri: &Uri) -> Response {
    let mut response = StatusCode::ACCEPTED.into_response();
    let headers = response.headers_mut();
    headers.insert(header::RETRY_AFTER, HeaderValue::from(RETRY_AFTER));
    let here = uri.path_and_query().map_or("/", |path| path.as_str());
    if let Ok(here) = HeaderValue::from_str(here) {
        headers.insert(header::LOCATION, here);
    }
    response
}

/// The tag of `content` as this version answers it: equal requests for equal materials
/// have equal answers, so the tag needs no file.
fn tag_of(content: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let digest = Sha256::digest(format!("{version} {content}"));
    format!("\"sha256-{digest:x}\"")
}
