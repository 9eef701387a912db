//! `GET /v1/materials/{name}/table.mtab?…`: a colour table by one URL.

use axum::{
    extract::{Path, Query, State},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{
    Control,
    material::{MaterialError, query::ColourNames, table},
};
use rise_bridge::write::Style;
use serde::Deserialize;
use sha2::{Digest, Sha256};

use super::{App, error::ApiError, materials::Kept};
use crate::{products::Product, wanted::Wanted};

/// What the URL asks for; angles in degrees, wavelengths in nm.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Asked {
    thetai: String,
    thetas: String,
    phis: Option<String>,
    patch: Option<String>,
    lambda: Option<String>,
    illuminant: Option<String>,
    observer: Option<String>,
    space: Option<String>,
    adaptation: Option<String>,
    quantity: Option<String>,
    filter: Option<String>,
    incident: Option<String>,
    basis: Option<String>,
    #[serde(default)]
    stokes: u8,
    digits: Option<usize>,
    #[serde(default)]
    xyz: u8,
    /// Which Stokes component of the spectra: 0 … 3.
    #[serde(default)]
    component: usize,
}

/// `GET /v1/materials/{name}/table.{mtab|mspd|json|svg}`
pub(super) async fn table(
    State(app): State<App>,
    Path((name, file)): Path<(String, String)>,
    Query(asked): Query<Asked>,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let product =
        Product::of_name(&file).filter(|_| file.starts_with("table.")).ok_or_else(|| {
            ApiError::NotFound(format!("{file}: ask for table.mtab, .mspd, .json or .svg"))
        })?;
    let kept = app.materials.find(&name)?;
    let tag = tag(&kept, product, &asked);
    if headers.get(header::IF_NONE_MATCH).is_some_and(|given| given.as_bytes() == tag.as_bytes()) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let text = app.compute.run(move || text(&name, &kept, product, &asked)).await??;
    let kind = product.content_type().to_owned();
    Ok(([(header::ETAG, tag), (header::CONTENT_TYPE, kind)], text).into_response())
}

/// Equal requests for equal materials have equal answers, so the tag needs no table.
fn tag(kept: &Kept, product: Product, asked: &Asked) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let digest = Sha256::digest(format!("{version} {} {product:?} {asked:?}", kept.hash));
    format!("\"sha256-{digest:x}\"")
}

fn text(name: &str, kept: &Kept, product: Product, asked: &Asked) -> Result<String, ApiError> {
    let request = asked.wanted().request(name, None)?;
    let table = table::table(&kept.prepared, &request, &Control::default())?;
    let style = Style { digits: asked.digits.unwrap_or(9).clamp(1, 17), xyz: asked.xyz != 0 };
    product
        .text(&table, asked.component.min(3), style)
        .map_err(|error| ApiError::from(MaterialError::NotFinite(error.to_string())))
}

impl Asked {
    fn wanted(&self) -> Wanted {
        let phis = self.phis.as_ref().map(|phis| format!(",phis={phis}")).unwrap_or_default();
        Wanted {
            grid: Some(format!("thetai={},thetas={}{phis}", self.thetai, self.thetas)),
            patches: None,
            patch: self.patch.clone(),
            lambda: self.lambda.clone(),
            incident: self.incident.clone(),
            basis: self.basis.clone(),
            stokes: self.stokes != 0,
            colours: ColourNames {
                illuminant: self.illuminant.clone(),
                observer: self.observer.clone(),
                space: self.space.clone(),
                adaptation: self.adaptation.clone(),
                quantity: self.quantity.clone(),
                filters: self.filter.iter().cloned().collect(),
            },
        }
    }
}
