//! Colour tables of a grid or of patches by one URL: computed once, kept, and told by their tag.

use axum::{
    body::Bytes,
    extract::State,
    http::{HeaderMap, Uri},
    response::Response,
};
use mist_engine::{
    material::{MaterialError, table},
    request::{GridPatch, Patch, TableDirections, TableRequest},
};
use rise_bridge::formats::{self, ColourWriter, FORMATS, FileFormat, FormatWriter};
use serde::Deserialize;
use utoipa::IntoParams;

use super::{
    client::Client,
    error::ApiError,
    export,
    extract::PathParameters,
    file_response::FileRequest,
    problem::Problems,
    query::{MaterialQuery, admit},
    state::App,
    warnings::with_warnings,
};
use crate::compute::WorkSize;

/// Points of a small table, times wavelengths.
const SMALL_POINTS: f64 = 20_000.0;
/// Solid angles of a small table, times wavelengths.
const SMALL_PATCHES: f64 = 200.0;

/// A table of a material.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Path)]
#[expect(dead_code, reason = "describes the API")]
pub(super) struct TablePath {
    /// The name of the material.
    name: String,
    /// `table.mtab`, `table.mspd`, `table.json` or `table.svg`. As `mist export` makes them, with
    /// the keys of its flags: `table.pbsdf`, `.bsdf`, `.RISEdataBSDF`, `.xompt`, `.astm`, `.csv`
    /// and `.xml`.
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
    operation_id = "material_table",
    tag = "materials",
    params(TablePath, MaterialQuery),
    responses(
        (status = 200, description = "The table", headers(("ETag" = String)), content(
            (String = "text/plain"), (serde_json::Value = "application/json"), (String = "image/svg+xml"),
            (Vec<u8> = "application/octet-stream"),
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
    PathParameters((name, file)): PathParameters<(String, String)>,
    client: Client,
    uri: Uri,
    headers: HeaderMap,
) -> Result<Response, ApiError> {
    let format = format_of(&file)?;
    match format.writer {
        FormatWriter::Colours(writer) => {
            colours(&app, &client, &name, (format, writer), (&headers, &uri)).await
        }
        FormatWriter::Material(writer) => {
            export::answer(&app, &client, name, (format, writer), (&headers, &uri)).await
        }
    }
}

/// The format of the file `table.EXTENSION`.
fn format_of(file: &str) -> Result<&'static FileFormat, ApiError> {
    let is_table = file.strip_prefix("table.").is_some_and(|rest| !rest.contains('.'));
    FileFormat::of_file(file).filter(|_| is_table).ok_or_else(|| {
        let known = formats::extensions(FORMATS.into_iter());
        ApiError::NotFound(format!("{file}: ask for table with one of {known}"))
    })
}

async fn colours(
    app: &App,
    client: &Client,
    name: &str,
    (format, writer): (&'static FileFormat, ColourWriter),
    (headers, uri): (&HeaderMap, &Uri),
) -> Result<Response, ApiError> {
    let query = MaterialQuery::of(uri)?;
    let kept = app.materials.find(name)?;
    let mut request = query.request(name)?;
    let style = query.style();
    let form = (format.name, query.component(), style.digits, style.xyz);
    let content = (&kept.hash, form, &request);
    let file = FileRequest::new(&content, format.media_type, query.wait(), (headers, uri))?;
    if let Some(answer) = file.not_modified() {
        return Ok(answer);
    }
    admit(&request, &client.limits)?;
    request.limits = client.limits.engine(client.limits.max_time);
    let bytes = memory_of(&request);
    let size = size_of(&request);
    let warnings = request.warnings();
    let work = move |control: &mist_engine::Control| {
        let table = table::table(&kept.prepared, &request, control)?;
        let text = (writer.text)(&table, query.component(), style)
            .map_err(|error| MaterialError::NotFinite(error.to_string()))?;
        Ok(Bytes::from(text))
    };
    Ok(with_warnings(file.answer(app, client, (bytes, size), work).await?, &warnings))
}

/// The size of the computation of a table.
pub(super) fn size_of(request: &TableRequest) -> WorkSize {
    let waves = request.wavelengths.len() as f64;
    let is_point = match &request.directions {
        TableDirections::Grid(grid) => grid.patch == GridPatch::Point,
        TableDirections::List(rows) => rows.iter().all(|row| row.patch == Patch::Point),
    };
    let most = if is_point { SMALL_POINTS } else { SMALL_PATCHES };
    if request.directions.rows() * waves <= most { WorkSize::Small } else { WorkSize::Large }
}

/// Bytes of a table and of its text while it is made, about: its numbers as f64 and with about
/// 16 characters, and for each row its directions, colours and flags twice.
pub(super) fn memory_of(request: &TableRequest) -> f64 {
    let components = if request.stokes { 4.0 } else { 1.0 };
    request.directions.rows() * (512.0 + 24.0 * components * request.wavelengths.len() as f64)
}
