//! Tables for Mitsuba by one URL: `.pbsdf` with Mueller matrices, `.bsdf` with reflection.

use std::sync::Arc;

use axum::{
    extract::{Path, Query, State, rejection::QueryRejection},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
};
use mist_engine::{
    Control,
    material::{MaterialError, query},
};
use rise_bridge::{
    export::{Bands, ExportError},
    mitsuba::{
        axes::Axes,
        bsdf::{self, Channels, Size},
        pbsdf,
    },
};
use serde::Deserialize;
use serde_json::json;

use super::{
    App,
    error::ApiError,
    materials::Kept,
    table::{Leash, is_known, tag_of},
};

/// Largest answer, bytes: it is made in memory.
const MOST_BYTES: usize = 256 << 20;

/// The keys of a query; all have defaults.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Asked {
    /// Nodes, as on the command line.
    grid: Option<String>,
    /// Wavelengths, nm.
    lambda: Option<String>,
    /// Even steps of θ_h (`.pbsdf`).
    uniform: u8,
    /// Any number of wavelengths, for our plugin (`.pbsdf`).
    plugin: u8,
    /// Colours in the place of spectra (`.bsdf`).
    rgb: u8,
}

/// `GET /v1/materials/{name}/table.pbsdf`
pub(super) async fn pbsdf(
    state: State<App>,
    path: Path<String>,
    asked: Result<Query<Asked>, QueryRejection>,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    answer(state, path, asked, headers, ("pbsdf", polarized)).await
}

/// `GET /v1/materials/{name}/table.bsdf`
pub(super) async fn bsdf(
    state: State<App>,
    path: Path<String>,
    asked: Result<Query<Asked>, QueryRejection>,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    answer(state, path, asked, headers, ("bsdf", reflection)).await
}

/// Makes the bytes of a table.
type Make = fn(&str, &Kept, &Asked, &Control) -> Result<Vec<u8>, ExportError>;

async fn answer(
    State(app): State<App>,
    Path(name): Path<String>,
    asked: Result<Query<Asked>, QueryRejection>,
    headers: HeaderMap,
    (format, make): (&'static str, Make),
) -> Result<Response, ApiError> {
    let Query(asked) = asked.map_err(|error| ApiError::Query(error.body_text()))?;
    let kept: Arc<Kept> = app.materials.find(&name)?;
    let tag = tag_of(&format!("{name:?} {} {format} {asked:?}", kept.hash));
    if is_known(&headers, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, [(header::ETAG, tag)]).into_response());
    }
    let leash = Leash::default();
    let control = Control { cancel: leash.flag(), progress: None };
    let bytes = app.compute.run(move || make(&name, &kept, &asked, &control)).await?;
    let bytes = bytes.map_err(refused)?;
    let head = [(header::CONTENT_TYPE, "application/octet-stream".to_owned()), (header::ETAG, tag)];
    Ok((head, bytes).into_response())
}

fn polarized(
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let nm = wavelengths(asked, "450,500,550,600,650")?;
    let axes = Axes::parse(asked.grid.as_deref().unwrap_or("37x46x91"), asked.uniform != 0)?;
    fits(axes.nodes().saturating_mul(nm.len() * 64))?;
    let bands = pbsdf::bands(&kept.prepared, &nm, asked.plugin == 0)?;
    pbsdf::write(&bands, &axes, &description(name), Vec::new(), control)
}

fn reflection(
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let (usual, channels) = match asked.rgb {
        0 => ("400:10:700", Channels::Spectra),
        _ => ("360:10:830", Channels::Rgb),
    };
    let bands = Bands::new(&kept.prepared, &wavelengths(asked, usual)?)?;
    let grid = if bands.is_isotropic() { "24x64" } else { "37x20x48" };
    let size = Size::parse(asked.grid.as_deref().unwrap_or(grid))?;
    fits(size.phi_i * size.theta_i * size.side * size.side * 4 * (bands.nm().len() + 1))?;
    bsdf::write(&bands, channels, size, &description(name), Vec::new(), control)
}

fn wavelengths(asked: &Asked, usual: &str) -> Result<Vec<f64>, ExportError> {
    Ok(query::nodes("lambda", asked.lambda.as_deref().unwrap_or(usual))?)
}

fn fits(bytes: usize) -> Result<(), ExportError> {
    if bytes <= MOST_BYTES {
        return Ok(());
    }
    let problem = format!("the table has {bytes} bytes, more than {MOST_BYTES}: use mist export");
    Err(ExportError::refused("grid", problem))
}

fn description(name: &str) -> String {
    let generator = format!("mist {}", env!("CARGO_PKG_VERSION"));
    json!({ "generator": generator, "material": name }).to_string()
}

fn refused(error: ExportError) -> ApiError {
    match error {
        ExportError::Refused { part, problem } => MaterialError::Request { part, problem }.into(),
        ExportError::Material(error) => error.into(),
        ExportError::Cancelled => MaterialError::Cancelled.into(),
        ExportError::Tensor(_) | ExportError::Io(_) => ApiError::Failed(error.to_string()),
    }
}
