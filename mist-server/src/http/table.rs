//! Colour tables: of a grid or of patches by one URL, of patches in the body of a request.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use axum::{
    extract::{Path, State},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{
    Control,
    material::{MaterialError, table},
};
use sha2::{Digest, Sha256};

use super::{App, asked::Asked, error::ApiError, materials::Kept};
use crate::{products::Product, wanted::Wanted};

/// `GET /v1/materials/{name}/table.{mtab|mspd|json|svg}`
pub(super) async fn table(
    State(app): State<App>,
    Path((name, file)): Path<(String, String)>,
    asked: Asked,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let product =
        Product::of_name(&file).filter(|_| file.starts_with("table.")).ok_or_else(|| {
            ApiError::NotFound(format!(
                "{file}: ask for table.mtab, .mspd, .json, .svg, .pbsdf, .bsdf, .RISEdataBSDF, .xompt, .astm, .csv or .xml"
            ))
        })?;
    let kept = app.materials.find(&name)?;
    let wanted = asked.wanted()?;
    let tag = tag(&name, &kept, product, &asked);
    if is_known(&headers, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let answer = answer(&app, name, kept, product, (wanted, asked)).await?;
    Ok(([(header::ETAG, tag)], answer).into_response())
}

/// `POST /v1/materials/{name}/integrate`: rows `thetai thetas phis circle 2` in the body.
pub(super) async fn integrate(
    State(app): State<App>,
    Path(name): Path<String>,
    asked: Asked,
    rows: String,
) -> Result<Response, ApiError> {
    let kept = app.materials.find(&name)?;
    let wanted = asked.wanted_at(rows);
    answer(&app, name, kept, Product::Table, (wanted, asked)).await
}

async fn answer(
    app: &App,
    name: String,
    kept: Arc<Kept>,
    product: Product,
    (wanted, asked): (Wanted, Asked),
) -> Result<Response, ApiError> {
    let leash = Leash::default();
    let control = Control { cancel: leash.flag(), progress: None };
    let work = move || -> Result<String, ApiError> {
        let request = wanted.request(&name, None)?;
        let table = table::table(&kept.prepared, &request, &control)?;
        product
            .text(&table, asked.component(), asked.style())
            .map_err(|error| MaterialError::NotFinite(error.to_string()).into())
    };
    let text = app.compute.run(work).await??;
    Ok(([(header::CONTENT_TYPE, product.content_type())], text).into_response())
}

/// Stops the work when the answer is not awaited any more, because the client has gone.
#[derive(Default)]
pub(super) struct Leash(Arc<AtomicBool>);

impl Leash {
    /// What is set when nobody waits any more.
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        self.0.clone()
    }
}

impl Drop for Leash {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Equal requests for equal materials have equal answers, so the tag needs no table.
fn tag(name: &str, kept: &Kept, product: Product, asked: &Asked) -> String {
    tag_of(&format!("{name:?} {} {product:?} {asked:?}", kept.hash))
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
