//! Integrals over the solid angles that a renderer names.

use axum::{
    extract::State,
    http::header,
    response::{IntoResponse, Response},
};
use mist_engine::{
    Control,
    material::{MaterialError, lobes::LobeOutput, table},
    request::{PatchList, TableRequest, read},
};
use rise_bridge::write;
use serde::Deserialize;
use utoipa::ToSchema;

use super::{
    client::Client,
    error::ApiError,
    extract::{Accept, MistText, PathParameters},
    problem::Problems,
    query::{MaterialQuery, admit},
    schema,
    state::App,
    table::{memory_of, size_of},
    warnings::with_warnings,
};
use crate::materials::StoredMaterial;

/// Solid angles as JSON.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PatchesJson {
    patches: PatchList,
}

/// Solid angles as JSON.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct Patches {
    /// In the order of the answer.
    patches: Vec<PatchBody>,
}

/// One solid angle, degrees.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct PatchBody {
    /// Polar angle of incidence.
    #[schema(example = 45.0)]
    thetai: f64,
    /// Polar angle of the centre.
    #[schema(example = 45.0)]
    thetas: f64,
    /// Azimuth of the centre; 0 is the specular side.
    #[schema(example = 0.0)]
    phis: f64,
    /// Half-angle of a cone.
    #[schema(example = 2.0)]
    circle: Option<f64>,
    /// Half-angles of the two cones between which light is collected.
    ring: Option<[f64; 2]>,
    /// Corners (polar angle, azimuth).
    polygon: Option<Vec<[f64; 2]>>,
}

/// The rows of a body: JSON, or one per line.
fn rows(body: &MistText) -> Result<PatchList, ApiError> {
    if !body.is_json {
        return Ok(read("patches", &body.text)?);
    }
    let PatchesJson { patches } = serde_json::from_str(&body.text)
        .map_err(|error| ApiError::Body(format!("not a list of patches: {error}")))?;
    Ok(patches)
}

/// Means over solid angles: rows `thetai thetas phis circle 2`, `… ring 10 12`, `… polygon t p t
/// p …` in degrees, or the same as JSON. The rows of the answer have the order of the request.
#[utoipa::path(
    post,
    path = "/v1/materials/{name}/integrate",
    operation_id = "integrate_material",
    tag = "materials",
    params(schema::MaterialName, MaterialQuery),
    request_body(content((String = "application/x-mist"), (Patches = "application/json"))),
    responses(
        (status = 200, description = "A table of colours, spectra or Mueller matrices", content(
            (String = "text/plain"), (serde_json::Value = "application/json"),
        )),
        Problems,
    ),
)]
pub(super) async fn integrate(
    State(app): State<App>,
    PathParameters(name): PathParameters<String>,
    query: MaterialQuery,
    accept: Accept,
    client: Client,
    body: MistText,
) -> Result<Response, ApiError> {
    let out = LobeOutput::parse(query.out().unwrap_or("rgb"))?;
    let kept = app.materials.find(&name)?;
    let mut request = query.request_at(rows(&body)?, &name)?;
    admit(&request, &client.limits)?;
    request.limits = client.limits.engine(client.limits.max_time);
    request.stokes |= query.component() > 0;
    let json = accept == Accept::Json;
    let values = if out == LobeOutput::Mueller { 16.0 } else { 1.0 };
    let held = app.memory.reserve(values * memory_of(&request))?;
    let size = size_of(&request);
    let warnings = request.warnings();
    let work = move |control: &Control| {
        let _held = held;
        answer(&kept, &request, &query, control, (out, json))
    };
    let text = app.compute_in_time(&client, size, work).await??;
    let kind = if json { "application/json" } else { "text/plain; charset=utf-8" };
    let response = ([(header::CONTENT_TYPE, kind)], text).into_response();
    Ok(with_warnings(response, &warnings))
}

/// The text of the answer.
fn answer(
    kept: &StoredMaterial,
    request: &TableRequest,
    query: &MaterialQuery,
    control: &Control,
    (out, json): (LobeOutput, bool),
) -> Result<String, ApiError> {
    let style = query.style();
    let text = match (out, json) {
        (LobeOutput::Mueller, _) => {
            let rows = table::mueller(&kept.prepared, request, control)?;
            if json {
                write::mueller_json(request, &rows)
            } else {
                write::mueller(request, &rows, style)
            }
        }
        (LobeOutput::Spectral, _) => {
            let table = table::table(&kept.prepared, request, control)?;
            if json {
                write::spectra_json(&table, query.component())
            } else {
                write::mspd(&table, query.component(), style)
            }
        }
        (LobeOutput::Rgb, json) => {
            let table = table::table(&kept.prepared, request, control)?;
            if json { write::json(&table, style.xyz) } else { write::mtab(&table, style) }
        }
    };
    text.map_err(|error| MaterialError::NotFinite(error.to_string()).into())
}
