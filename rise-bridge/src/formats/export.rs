//! The request for a table of a material, of all formats together.

use mist_engine::request::{Wavelengths, read};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::{export::ExportError, rise::material::SurfacePolarizer};

/// The table that is asked for; a format refuses an option that it does not have.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub struct ExportRequest {
    /// Name of the material, for the description inside the table.
    pub name: String,
    /// Wavelengths in nm: a list, FIRST:STEP:LAST, or both; the format has a default.
    pub lambda: Option<String>,
    /// Nodes of the table in the grammar of the format; the format has a default.
    pub grid: Option<String>,
    /// Even steps of θ_h (`pbsdf`).
    pub uniform: bool,
    /// Any number of wavelengths, for our plugin (`pbsdf`).
    pub plugin: bool,
    /// Colours in the place of spectra (`bsdf`).
    pub rgb: bool,
    /// Nodes of each polar angle (`rise`).
    pub nodes: Option<usize>,
    /// Behind a filter: `s` or `p` (`rise`).
    pub filter: Option<String>,
    /// True if the material computes NIST's numbers, for the description inside the table.
    pub compat: bool,
    /// Allows the grid `auto:PERCENT`, and estimates the error of interpolation.
    pub estimate_error: bool,
    /// Most bytes of a table, if it is made in memory.
    pub max_bytes: Option<f64>,
}

impl ExportRequest {
    /// Names of the options that are set and that not every format has.
    pub(super) fn options(&self) -> impl Iterator<Item = &'static str> {
        let all = [
            ("grid", self.grid.is_some()),
            ("uniform", self.uniform),
            ("plugin", self.plugin),
            ("rgb", self.rgb),
            ("nodes", self.nodes.is_some()),
            ("filter", self.filter.is_some()),
        ];
        all.into_iter().filter(|(_, is_set)| *is_set).map(|(name, _)| name)
    }

    /// The wavelengths in nm, by default `usual`.
    pub(super) fn wavelengths(&self, usual: &str) -> Result<Vec<f64>, ExportError> {
        let text = self.lambda.as_deref().unwrap_or(usual);
        Ok(read::<Wavelengths>("lambda", text)?.into_vec())
    }

    /// The part that the grid `auto:PERCENT` allows; nothing for other grids.
    pub(super) fn tolerance(&self, grid: &str) -> Result<Option<f64>, ExportError> {
        let percent = grid.strip_prefix("auto:").filter(|_| self.estimate_error);
        let Some(percent) = percent else { return Ok(None) };
        let part = percent.parse::<f64>().ok().filter(|x| *x > 0.0).map(|x| 0.01 * x);
        let refused =
            || ExportError::refused("grid", format!("{grid}: expected a percentage above 0"));
        part.map(Some).ok_or_else(refused)
    }

    /// The origin of a table with this `quantity`, as JSON.
    pub(super) fn description(&self, quantity: &str) -> String {
        let description = json!({
            "generator": format!("mist {}", env!("CARGO_PKG_VERSION")),
            "material": self.name,
            "quantity": quantity,
            "compat": self.compat,
        });
        description.to_string()
    }

    /// Refuses a table of so many bytes, the product of `counts`, before it is made.
    pub(super) fn refuse_above(&self, counts: &[usize]) -> Result<(), ExportError> {
        let bytes: f64 = counts.iter().map(|count| *count as f64).product();
        match self.max_bytes {
            Some(most) if bytes > most => {
                let problem =
                    format!("the table has {bytes:.0} bytes, more than {most}: use mist export");
                Err(ExportError::refused("grid", problem))
            }
            _ => Ok(()),
        }
    }

    /// The filter in the plane of incidence, if there is one.
    pub(super) fn filter(&self) -> Result<Option<SurfacePolarizer>, ExportError> {
        match self.filter.as_deref() {
            None => Ok(None),
            Some("s") => Ok(Some(SurfacePolarizer::S)),
            Some("p") => Ok(Some(SurfacePolarizer::P)),
            Some(_) => Err(ExportError::refused("filter", "expected s or p")),
        }
    }
}

/// The error of interpolation, in parts of 1, as a phrase.
pub(super) fn error_of_f(median: f64, quantile_95: f64) -> String {
    format!(
        "the error of f is {:.2} % (median) and {:.2} % (95 % of the light)",
        100.0 * median,
        100.0 * quantile_95
    )
}
