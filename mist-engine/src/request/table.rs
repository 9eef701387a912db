//! A colour table of a material: the texts of the request, and the request.

use scattering::Basis;
use serde::{Deserialize, Serialize, Serializer};
use spectra::ColourSettings;

use super::{
    colours::{ColourQuery, SettingsJson},
    error::{RequestError, read},
    grid::GridRequest,
    incident::IncidentLight,
    nodes::Wavelengths,
    patch::{PatchList, PatchRow},
};
use crate::{
    Files, Limits,
    sampling::{Outlines, PlaneSampling},
};

/// The texts of a request for a table; missing ones have defaults.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct TableQuery {
    /// All axes of a grid: `thetai=0:2:90,thetas=0:2:90,phis=0:2:180`.
    pub grid: Option<String>,
    /// Polar angles of incidence of a grid, if it is not given by `grid`.
    pub thetai: Option<String>,
    /// Polar angles of scattering of a grid.
    pub thetas: Option<String>,
    /// Azimuths of a grid.
    pub phis: Option<String>,
    /// The solid angle of a grid's nodes; `point`.
    pub patch: Option<String>,
    /// Solid angles in the place of a grid.
    pub patches: Option<PatchList>,
    /// Wavelengths, nm; `360:5:830`.
    pub lambda: Option<String>,
    /// Incident Stokes vector; `1,0,0,0`.
    pub incident: Option<String>,
    /// Polarization basis of the exit light; `psps`.
    pub basis: Option<String>,
    /// True if Q, U and V follow I.
    pub stokes: bool,
    /// Illuminant, observer, space, adaptation, quantity, filters.
    pub colours: ColourQuery,
}

impl TableQuery {
    /// The request for a table of the material called `name`; an illuminant may be one of `files`.
    ///
    /// # Errors
    ///
    /// For a part that cannot be read, with its key and what is accepted.
    pub fn request(
        &self,
        name: &str,
        files: Option<&dyn Files>,
    ) -> Result<TableRequest, RequestError> {
        let directions = self.directions()?;
        self.request_for(directions, name, files)
    }

    /// The same for other directions than those of the query.
    ///
    /// # Errors
    ///
    /// As [`TableQuery::request`].
    pub fn request_for(
        &self,
        directions: TableDirections,
        name: &str,
        files: Option<&dyn Files>,
    ) -> Result<TableRequest, RequestError> {
        let wavelengths = self.lambda.as_deref().unwrap_or("360:5:830");
        Ok(TableRequest {
            material: name.to_owned(),
            directions,
            wavelengths: read::<Wavelengths>("lambda", wavelengths)?.into_vec(),
            settings: self.colours.settings(files)?,
            incident: match &self.incident {
                Some(text) => read::<IncidentLight>("incident", text)?.0,
                None => IncidentLight::default().0,
            },
            stokes: self.stokes,
            basis: read("basis", self.basis.as_deref().unwrap_or("psps"))?,
            sampling: None,
            limits: Limits::default(),
        })
    }

    /// True when the query names a grid, its axes or patches.
    pub fn has_directions(&self) -> bool {
        let axes = [&self.grid, &self.thetai, &self.thetas, &self.phis];
        self.patches.is_some() || axes.iter().any(|axis| axis.is_some())
    }

    /// The directions of the query.
    fn directions(&self) -> Result<TableDirections, RequestError> {
        if let Some(PatchList(rows)) = &self.patches {
            return Ok(TableDirections::List(rows.clone()));
        }
        let patch = read("patch", self.patch.as_deref().unwrap_or("point"))?;
        let axes = [&self.thetai, &self.thetas, &self.phis];
        let grid = match &self.grid {
            Some(grid) => GridRequest::of_text(grid, patch)?,
            None if axes.iter().all(|axis| axis.is_none()) => {
                let problem = "expected a grid by thetai, thetas and phis, or patches";
                return Err(RequestError::new("grid", problem));
            }
            None => {
                let [thetai, thetas, phis] = axes.map(Option::as_deref);
                GridRequest::of_axes(thetai, thetas, phis, patch)?
            }
        };
        Ok(TableDirections::Grid(grid))
    }
}

/// A request for a table.
#[derive(Clone, Debug)]
pub struct TableRequest {
    /// Name of the material, for the header.
    pub material: String,
    /// The directions and their solid angles.
    pub directions: TableDirections,
    /// Wavelengths, nm, rising.
    pub wavelengths: Vec<f64>,
    /// Settings for colours of spectra; the quantity is `brdf` or `factor`.
    pub settings: ColourSettings,
    /// Incident Stokes vector.
    pub incident: [f64; 4],
    /// True if Q, U and V follow I.
    pub stokes: bool,
    /// The polarization basis.
    pub basis: Basis,
    /// Grid in which cones, annuli and polygons are laid out. Without it patches are adaptive in
    /// sound mode and have the default grid in compat mode.
    pub sampling: Option<PlaneSampling>,
    /// Limits of the cost; they change no value.
    pub limits: Limits,
}

/// The directions of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TableDirections {
    /// Every combination of nodes.
    Grid(GridRequest),
    /// These, in this order.
    List(Vec<PatchRow>),
}

impl TableDirections {
    /// The number of rows of the table.
    pub fn rows(&self) -> f64 {
        match self {
            Self::Grid(grid) => [&grid.thetai, &grid.thetas, &grid.phis]
                .iter()
                .map(|axis| axis.len() as f64)
                .product(),
            Self::List(list) => list.len() as f64,
        }
    }
}

/// The canonical JSON of a [`TableRequest`]: everything that its table depends on.
#[derive(Serialize)]
struct TableRequestJson<'a> {
    material: &'a str,
    directions: &'a TableDirections,
    wavelengths: &'a [f64],
    colours: SettingsJson<'a>,
    incident: IncidentLight,
    stokes: bool,
    basis: &'static str,
    sampling: Option<SamplingJson>,
}

/// The canonical JSON of a [`PlaneSampling`].
#[derive(Serialize)]
struct SamplingJson {
    projection: &'static str,
    differential: f64,
    min_samples: i32,
    is_normalized: bool,
    polygon_sides: Option<i32>,
}

impl From<&PlaneSampling> for SamplingJson {
    fn from(sampling: &PlaneSampling) -> Self {
        let PlaneSampling { projection, differential, min_samples, is_normalized, outlines } =
            *sampling;
        let polygon_sides = match outlines {
            Outlines::Exact => None,
            Outlines::Polygons { sides } => Some(sides),
        };
        let projection = projection.name();
        Self { projection, differential, min_samples, is_normalized, polygon_sides }
    }
}

/// Equal requests have equal JSON; the limits are left out.
impl Serialize for TableRequest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let json = TableRequestJson {
            material: &self.material,
            directions: &self.directions,
            wavelengths: &self.wavelengths,
            colours: SettingsJson::new(&self.settings),
            incident: IncidentLight(self.incident),
            stokes: self.stokes,
            basis: self.basis.name(),
            sampling: self.sampling.as_ref().map(SamplingJson::from),
        };
        json.serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn json(query: &TableQuery) -> String {
        serde_json::to_string(&query.request("gold", None).unwrap()).unwrap()
    }

    fn query(thetai: &str, lambda: Option<&str>) -> TableQuery {
        TableQuery {
            thetai: Some(thetai.into()),
            thetas: Some("0:10:80".into()),
            phis: Some("0,180".into()),
            lambda: lambda.map(str::to_owned),
            ..TableQuery::default()
        }
    }

    #[test]
    fn equal_requests_have_equal_json_whatever_their_texts() {
        let written = TableQuery {
            grid: Some("phis=0.0,1.8e2,thetas=0:10:80,thetai=0,30".into()),
            patch: Some("point".into()),
            incident: Some("1,0,-0,0.0".into()),
            ..TableQuery::default()
        };
        assert_eq!(json(&query("0:30:30", None)), json(&written));
        assert_eq!(json(&query("0.0", None)), json(&query("-0", Some("360:5:830"))));
        assert_ne!(json(&query("0", None)), json(&query("1", None)));
        let limited = TableRequest {
            limits: Limits { steps: 7, ..Limits::default() },
            ..query("0", None).request("gold", None).unwrap()
        };
        assert_eq!(serde_json::to_string(&limited).unwrap(), json(&query("0", None)));
    }

    #[test]
    fn errors_name_the_key() {
        let key = |query: TableQuery| query.request("gold", None).unwrap_err().key;
        assert_eq!(key(query("x", None)), "thetai");
        assert_eq!(key(query("0", Some("700:10"))), "lambda");
        assert_eq!(key(TableQuery { basis: Some("sp".into()), ..query("0", None) }), "basis");
        assert_eq!(key(TableQuery::default()), "grid");
    }
}
