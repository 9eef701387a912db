//! Tables of materials for renderers and optics programs, as `mist export` writes them.

use axum::{
    body::Bytes,
    http::{HeaderMap, Uri},
    response::Response,
};
use mist_engine::{
    Control, Warning,
    material::MaterialError,
    request::{RequestError, Wavelengths, read, wavelength_warning},
};
use rise_bridge::{
    export::ExportError,
    formats::{ExportRequest, FileFormat, MaterialWriter},
};
use serde::Deserialize;

use super::{
    client::Client, error::ApiError, extract::Query, file_response::FileRequest, state::App,
    warnings::with_warnings,
};

use crate::compute::WorkSize;

/// Largest answer, bytes: it is made in memory.
const MOST_BYTES: usize = 256 << 20;

/// The keys of a query; all have defaults.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct ExportQuery {
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
    /// Polar angles of incidence, degrees (goniometer tables).
    thetai: Option<String>,
    /// Polar angles of scattering, degrees (goniometer tables).
    thetas: Option<String>,
    /// Azimuths, degrees (goniometer tables).
    phis: Option<String>,
    /// Nodes of each polar angle (`.RISEdataBSDF`).
    nodes: Option<usize>,
    /// `s` or `p`: behind a filter (`.RISEdataBSDF`).
    filter: Option<String>,
    /// Seconds to wait for the table before 202.
    wait: Option<f64>,
}

impl ExportQuery {
    /// The same as one request.
    fn request(self, name: String) -> ExportRequest {
        let axes = [
            ("thetai", self.thetai, "0:10:80"),
            ("thetas", self.thetas, "0:5:85"),
            ("phis", self.phis, "0:10:180"),
        ];
        let has_axes = axes.iter().any(|(_, nodes, _)| nodes.is_some());
        let axes = axes
            .map(|(axis, nodes, usual)| format!("{axis}={}", nodes.as_deref().unwrap_or(usual)));
        ExportRequest {
            name,
            lambda: self.lambda,
            grid: self.grid.or_else(|| has_axes.then(|| axes.join(","))),
            uniform: self.uniform != 0,
            plugin: self.plugin != 0,
            rgb: self.rgb != 0,
            nodes: self.nodes,
            filter: self.filter,
            max_bytes: Some(MOST_BYTES as f64),
            ..ExportRequest::default()
        }
    }
}

/// The table of the material called `name` in `format`.
pub(super) async fn answer(
    app: &App,
    client: &Client,
    name: String,
    (format, writer): (&'static FileFormat, MaterialWriter),
    (headers, uri): (&HeaderMap, &Uri),
) -> Result<Response, ApiError> {
    let Query(query) = Query::<ExportQuery>::of(uri)?;
    let kept = app.materials.find(&name)?;
    let wait = query.wait;
    let request = query.request(name);
    let content = (&kept.hash, format.name, &request);
    let file = FileRequest::new(&content, format.media_type, wait, (headers, uri))?;
    if let Some(answer) = file.not_modified() {
        return Ok(answer);
    }
    let warnings = wavelength_warnings(&request)?;
    let work = move |control: &Control| {
        let mut bytes = Vec::new();
        writer.write(&kept.prepared, &request, &mut bytes, control).map_err(refused)?;
        Ok(Bytes::from(bytes))
    };
    Ok(with_warnings(
        file.answer(app, client, (MOST_BYTES as f64, WorkSize::Large), work).await?,
        &warnings,
    ))
}

/// Warnings of wavelengths that look like another unit than nm.
fn wavelength_warnings(request: &ExportRequest) -> Result<Vec<Warning>, ApiError> {
    let Some(text) = &request.lambda else { return Ok(Vec::new()) };
    let nm = read::<Wavelengths>("lambda", text)?.into_vec();
    Ok(wavelength_warning(&nm).into_iter().collect())
}

fn refused(error: ExportError) -> ApiError {
    match error {
        ExportError::Refused { part, problem } => {
            MaterialError::from(RequestError::new(part, problem)).into()
        }
        ExportError::Material(error) => error.into(),
        ExportError::Cancelled => MaterialError::Cancelled.into(),
        ExportError::Tensor(_) | ExportError::Io(_) => ApiError::Failed(error.to_string()),
    }
}
