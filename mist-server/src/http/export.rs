//! Tables for renderers and optics programs by one URL, as `mist export` writes them.

use std::sync::Arc;

use axum::{
    Router,
    extract::{Path, Query, State, rejection::QueryRejection},
    http::{HeaderMap, StatusCode, header},
    response::{IntoResponse, Response},
    routing::get,
};
use mist_engine::{
    Control,
    material::{MaterialError, query},
};
use rise_bridge::{
    export::{Bands, ExportError},
    goniometer::{self, Axes, Form},
    klems,
    mitsuba::{
        axes,
        bsdf::{self, Channels, Size},
        pbsdf,
    },
    rise::{material::Filter, product},
};
use serde::Deserialize;
use serde_json::json;

use super::{
    App,
    error::ApiError,
    materials::Kept,
    run::Leash,
    table::{is_known, tag_of},
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
}

/// The tables by the extension of their files.
const FORMATS: [(&str, Make); 7] = [
    ("pbsdf", polarized),
    ("bsdf", reflection),
    ("RISEdataBSDF", rings),
    ("xompt", |name, kept, asked, control| {
        directions(Form::OpenMaterial, name, kept, asked, control)
    }),
    ("astm", |name, kept, asked, control| directions(Form::Astm, name, kept, asked, control)),
    ("csv", |name, kept, asked, control| directions(Form::Ocean, name, kept, asked, control)),
    ("xml", patches),
];

/// `GET /v1/materials/{name}/table.{pbsdf|bsdf|RISEdataBSDF|xompt|astm|csv|xml}`
pub(super) fn routes(router: Router<App>) -> Router<App> {
    FORMATS.into_iter().fold(router, |router, format| {
        let one = move |state, path, asked, headers| answer(state, path, asked, headers, format);
        router.route(&format!("/v1/materials/{{name}}/table.{}", format.0), get(one))
    })
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
    let control = Control { cancel: leash.0.clone(), progress: None };
    let bytes = app.compute_in_time(move || make(&name, &kept, &asked, &control)).await?;
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
    let axes = axes::Axes::parse(asked.grid.as_deref().unwrap_or("37x46x91"), asked.uniform != 0)?;
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

/// Most nodes of a table over rings.
const MOST_NODES: usize = 181;

fn rings(_: &str, kept: &Kept, asked: &Asked, control: &Control) -> Result<Vec<u8>, ExportError> {
    let filter = match asked.filter.as_deref() {
        None => None,
        Some("s") => Some(Filter::S),
        Some("p") => Some(Filter::P),
        Some(_) => return Err(ExportError::refused("filter", "expected s or p")),
    };
    let nodes = asked.nodes.unwrap_or(46);
    if nodes > MOST_NODES {
        let problem = format!("{nodes}, more than {MOST_NODES}");
        return Err(ExportError::refused("nodes", problem));
    }
    let nm = wavelengths(asked, "380:10:780")?;
    Ok(product::table_of(&kept.prepared, filter, nodes, &nm, control)?.bytes())
}

fn directions(
    form: Form,
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let axis = |part: &str, given: &Option<String>, usual: &str| {
        query::nodes(part, given.as_deref().unwrap_or(usual))
    };
    let axes = Axes {
        thetai: axis("thetai", &asked.thetai, "0:10:80")?,
        thetas: axis("thetas", &asked.thetas, "0:5:85")?,
        phis: axis("phis", &asked.phis, "0:10:180")?,
    };
    let bands = Bands::new(&kept.prepared, &wavelengths(asked, "400:10:700")?)?;
    // A number has about 20 characters.
    fits(axes.directions().saturating_mul(bands.nm().len() * 20 + 80))?;
    goniometer::write(&bands, &axes, form, name, Vec::new(), control)
}

fn patches(
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let bands = Bands::new(&kept.prepared, &wavelengths(asked, "360:10:830")?)?;
    klems::write(&bands, name, Vec::new(), control)
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
