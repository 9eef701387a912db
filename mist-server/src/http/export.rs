//! Tables for renderers and optics programs by one URL, as `mist export` writes them.

use axum::{
    Router,
    extract::State,
    http::{HeaderMap, Uri},
    response::Response,
    routing::get,
};
use mist_engine::{
    Control,
    material::{MaterialError, query},
};
use rise_bridge::{
    export::{Bands, ExportError},
    goniometer::{self, GoniometerAxes, GoniometerForm},
    klems,
    mitsuba::{
        axes,
        bsdf::{self, BsdfChannels, BsdfSize},
        pbsdf,
    },
    rise::{material::SurfacePolarizer, product},
};
use serde::Deserialize;
use serde_json::json;

use super::{
    App,
    error::ApiError,
    extract::{Path, Query},
    file::Asker,
    materials::Kept,
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
    /// Seconds to wait for the table before 202.
    wait: Option<f64>,
}

/// The tables by the extension of their files.
const FORMATS: [(&str, Make); 7] = [
    ("pbsdf", polarized),
    ("bsdf", reflection),
    ("RISEdataBSDF", rings),
    ("xompt", |name, kept, asked, control| {
        directions(GoniometerForm::OpenMaterial, name, kept, asked, control)
    }),
    ("astm", |name, kept, asked, control| {
        directions(GoniometerForm::Astm, name, kept, asked, control)
    }),
    ("csv", |name, kept, asked, control| {
        directions(GoniometerForm::Ocean, name, kept, asked, control)
    }),
    ("xml", patches),
];

/// `GET /v1/materials/{name}/table.{pbsdf|bsdf|RISEdataBSDF|xompt|astm|csv|xml}`
pub(super) fn routes(router: Router<App>) -> Router<App> {
    FORMATS.into_iter().fold(router, |router, format| {
        let one = move |state, path, asked, headers, uri| {
            answer(state, path, asked, (headers, uri), format)
        };
        router.route(&format!("/v1/materials/{{name}}/table.{}", format.0), get(one))
    })
}

/// Makes the bytes of a table.
type Make = fn(&str, &Kept, &Asked, &Control) -> Result<Vec<u8>, ExportError>;

async fn answer(
    State(app): State<App>,
    Path(name): Path<String>,
    Query(asked): Query<Asked>,
    (headers, uri): (HeaderMap, Uri),
    (format, make): (&'static str, Make),
) -> Result<Response, ApiError> {
    let kept = app.materials.find(&name)?;
    let content =
        format!("{name:?} {} {format} {:?}", kept.hash, Asked { wait: None, ..asked.clone() });
    let asker = Asker::new(&content, "application/octet-stream", asked.wait, (&headers, &uri));
    if let Some(answer) = asker.known() {
        return Ok(answer);
    }
    let work = move |control: &Control| {
        let bytes = make(&name, &kept, &asked, control).map_err(refused)?;
        Ok(bytes.into())
    };
    asker.answer(&app, MOST_BYTES as f64, work).await
}

fn polarized(
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let nm = wavelengths(asked, "450,500,550,600,650")?;
    let axes = axes::HalfAngleAxes::parse(
        asked.grid.as_deref().unwrap_or("37x46x91"),
        asked.uniform != 0,
    )?;
    fits(&[axes.nodes(), nm.len(), 64])?;
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
        0 => ("400:10:700", BsdfChannels::Spectra),
        _ => ("360:10:830", BsdfChannels::Rgb),
    };
    let bands = Bands::new(&kept.prepared, &wavelengths(asked, usual)?)?;
    let grid = if bands.is_isotropic() { "24x64" } else { "37x20x48" };
    let size = BsdfSize::parse(asked.grid.as_deref().unwrap_or(grid))?;
    fits(&[size.phi_i, size.theta_i, size.side, size.side, 4, bands.nm().len() + 1])?;
    bsdf::write(&bands, channels, size, &description(name), Vec::new(), control)
}

/// Most nodes of a table over rings.
const MOST_NODES: usize = 181;

fn rings(_: &str, kept: &Kept, asked: &Asked, control: &Control) -> Result<Vec<u8>, ExportError> {
    let filter = match asked.filter.as_deref() {
        None => None,
        Some("s") => Some(SurfacePolarizer::S),
        Some("p") => Some(SurfacePolarizer::P),
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
    form: GoniometerForm,
    name: &str,
    kept: &Kept,
    asked: &Asked,
    control: &Control,
) -> Result<Vec<u8>, ExportError> {
    let axis = |part: &str, given: &Option<String>, usual: &str| {
        query::nodes(part, given.as_deref().unwrap_or(usual))
    };
    let axes = GoniometerAxes {
        thetai: axis("thetai", &asked.thetai, "0:10:80")?,
        thetas: axis("thetas", &asked.thetas, "0:5:85")?,
        phis: axis("phis", &asked.phis, "0:10:180")?,
    };
    let bands = Bands::new(&kept.prepared, &wavelengths(asked, "400:10:700")?)?;
    // A number has about 20 characters.
    fits(&[axes.directions(), bands.nm().len() * 20 + 80])?;
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

/// Refuses a table of so many bytes, the product of `counts`, before it is made.
fn fits(counts: &[usize]) -> Result<(), ExportError> {
    let bytes: f64 = counts.iter().map(|count| *count as f64).product();
    if bytes <= MOST_BYTES as f64 {
        return Ok(());
    }
    let problem =
        format!("the table has {bytes:.0} bytes, more than {MOST_BYTES}: use mist export");
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
