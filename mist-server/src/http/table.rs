//! Colour tables of a grid or of patches by one URL: computed once, kept, and told by their tag.

use std::{sync::Arc, time::Duration};

use axum::{
    body::Bytes,
    extract::State,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{
    Control,
    material::{
        MaterialError,
        table::{self, TableRequest},
    },
};
use serde::Deserialize;
use sha2::{Digest, Sha256};
use utoipa::IntoParams;

use super::{
    App,
    asked::{Asked, admit},
    error::{ApiError, Limit},
    extract::Path,
    flight::{Landing, Outcome},
    materials::Kept,
    problem::Problems,
};
use crate::products::Product;

/// Seconds that a client waits for a table unless it says otherwise.
const PATIENCE: f64 = 30.0;
/// Seconds after which a client may ask again for a table that is being computed.
const RETRY_AFTER: u32 = 1;

/// A table of a material.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct Named {
    /// The name of the material.
    name: String,
    /// `table.mtab`, `table.mspd`, `table.json` or `table.svg`.
    #[param(example = "table.mtab")]
    file: String,
}

/// The colour table of a material.
///
/// 200 with a strong `ETag`; 304 for `If-None-Match`; 202 with `Location` and `Retry-After` if it
/// takes longer than the client waits: 30 seconds, `?wait=SECONDS`, or the header `Prefer:
/// wait=SECONDS` or `Prefer: respond-async`.
#[utoipa::path(
    get,
    path = "/v1/materials/{name}/{file}",
    tag = "materials",
    params(Named, Asked),
    responses(
        (status = 200, description = "The table", headers(("ETag" = String)), content(
            (String = "text/plain"), (serde_json::Value = "application/json"), (String = "image/svg+xml"),
        )),
        (status = 202, description = "It is being computed: ask again", headers(
            ("Location" = String), ("Retry-After" = u32),
        )),
        (status = 304, description = "The client has it", headers(("ETag" = String))),
        Problems,
    ),
)]
pub(super) async fn table(
    State(app): State<App>,
    Path((name, file)): Path<(String, String)>,
    asked: Asked,
    uri: axum::http::Uri,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let product =
        Product::of_name(&file).filter(|_| file.starts_with("table.")).ok_or_else(|| {
            ApiError::NotFound(format!(
                "{file}: ask for table.mtab, .mspd, .json, .svg, .pbsdf, .bsdf, .RISEdataBSDF, .xompt, .astm, .csv or .xml"
            ))
        })?;
    let kept = app.materials.find(&name)?;
    let tag = tag(&name, &kept, product, &asked);
    if is_known(&headers, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let request = request(&app, &name, &asked)?;
    let (mut waiting, landing) = app.flights.join(&tag);
    app.metrics.count_table(landing.is_none());
    if let Some(landing) = landing {
        tokio::spawn(fly(app.clone(), landing, kept, product, request, asked.clone()));
    }
    match waiting.outcome(patience(&asked, &headers)).await {
        Some(Ok(text)) => {
            let headers = [(header::CONTENT_TYPE, product.content_type())];
            Ok(([(header::ETAG, tag)], headers, text).into_response())
        }
        Some(Err(problem)) => Err(ApiError::Told(Box::new(problem))),
        None => Ok(come_back(&uri)),
    }
}

/// The table that the query asks for, within the limits.
fn request(app: &App, name: &str, asked: &Asked) -> Result<TableRequest, ApiError> {
    let mut request = asked.wanted()?.request(name, None)?;
    admit(&request, &app.limits)?;
    request.limits = app.limits.engine(app.limits.max_time);
    Ok(request)
}

/// Computes a table for everybody who waits for it.
async fn fly(
    app: App,
    landing: Landing,
    kept: Arc<Kept>,
    product: Product,
    request: TableRequest,
    asked: Asked,
) {
    let control = Control { cancel: landing.cancel.clone(), progress: None };
    let work = move || -> Result<String, ApiError> {
        let table = table::table(&kept.prepared, &request, &control)?;
        product
            .text(&table, asked.component(), asked.style())
            .map_err(|error| MaterialError::NotFinite(error.to_string()).into())
    };
    let computed = tokio::time::timeout(app.limits.time(), app.compute.run(work)).await;
    let outcome: Outcome = match computed {
        Ok(Ok(Ok(text))) => Ok(Bytes::from(text)),
        Ok(Ok(Err(error))) => Err(error.problem()),
        Ok(Err(error)) => Err(ApiError::from(error).problem()),
        Err(_) => {
            landing.cancel.store(true, std::sync::atomic::Ordering::Relaxed);
            Err(too_long(&app).problem())
        }
    };
    landing.land(outcome);
}

/// The work takes longer than one answer may.
pub(super) fn too_long(app: &App) -> ApiError {
    let value = app.limits.max_time;
    let message = format!("the answer takes longer than {value} s");
    ApiError::Limit(Limit { flag: "max-time", value, message })
}

/// How long the client waits: as the query, the header `Prefer` (RFC 7240) or nobody says.
fn patience(asked: &Asked, headers: &HeaderMap) -> Duration {
    let prefers = headers.get_all("prefer").iter().filter_map(|value| value.to_str().ok());
    let mut preferred = None;
    for preference in prefers.flat_map(|list| list.split([',', ';'])).map(str::trim) {
        if let Some(seconds) = preference.strip_prefix("wait=") {
            preferred = seconds.trim_matches('"').parse().ok();
        } else if preference == "respond-async" && preferred.is_none() {
            preferred = Some(0.0);
        }
    }
    let seconds: f64 = asked.wait().or(preferred).unwrap_or(PATIENCE);
    Duration::try_from_secs_f64(seconds.clamp(0.0, 3600.0)).unwrap_or_default()
}

fn come_back(uri: &axum::http::Uri) -> Response {
    let mut response = StatusCode::ACCEPTED.into_response();
    let headers = response.headers_mut();
    headers.insert(header::RETRY_AFTER, HeaderValue::from(RETRY_AFTER));
    let here = uri.path_and_query().map_or("/", |path| path.as_str());
    if let Ok(here) = HeaderValue::from_str(here) {
        headers.insert(header::LOCATION, here);
    }
    response
}

/// Equal requests for equal materials have equal answers, so the tag needs no table.
fn tag(name: &str, kept: &Kept, product: Product, asked: &Asked) -> String {
    tag_of(&format!("{name:?} {} {product:?} {}", kept.hash, asked.key()))
}

/// The tag of what `request` says, as this version answers it.
pub(super) fn tag_of(request: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let digest = Sha256::digest(format!("{version} {request}"));
    format!("\"sha256-{digest:x}\"")
}

/// Whether the client has what `tag` names: `If-None-Match` is `*` or a list of tags.
pub(super) fn is_known(headers: &HeaderMap, tag: &str) -> bool {
    let given = headers.get_all(header::IF_NONE_MATCH).iter().filter_map(|v| v.to_str().ok());
    given
        .flat_map(|list| list.split(','))
        .map(|one| one.trim())
        .any(|one| one == "*" || one.strip_prefix("W/").unwrap_or(one) == tag)
}
