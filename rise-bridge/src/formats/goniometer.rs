//! Writer of the tables of goniometers.

use std::io::Write;

use mist_engine::{
    Control,
    material::PreparedMaterial,
    request::{GridPatch, GridRequest},
};

use super::export::{ExportRequest, error_of_f};
use crate::{
    export::{Bands, ExportError},
    goniometer::{self, GoniometerAxes, GoniometerForm},
};

/// Nodes of a table for which no grid was asked.
const GRID: &str = "thetai=0:10:80,thetas=0:5:85,phis=0:10:180";
/// Characters of a number, and of the rest of a line.
const CHARACTERS: [usize; 2] = [20, 80];

/// Writes the table; the line has the error of interpolation.
pub(super) fn write(
    form: GoniometerForm,
    (material, request): (&PreparedMaterial, &ExportRequest),
    out: &mut dyn Write,
    control: &Control,
) -> Result<String, ExportError> {
    let bands = Bands::new(material, &request.wavelengths("400:10:700")?)?;
    let grid = request.grid.as_deref().unwrap_or(GRID);
    let (axes, error) = match request.tolerance(grid)? {
        Some(part) => {
            let (axes, error) = goniometer::choose_axes(&bands, part)?;
            (axes, Some(error))
        }
        None => {
            let grid = GridRequest::of_text(grid, GridPatch::Point)?;
            let axes = GoniometerAxes { thetai: grid.thetai, thetas: grid.thetas, phis: grid.phis };
            axes.check()?;
            let line = bands.nm().len() * CHARACTERS[0] + CHARACTERS[1];
            request.refuse_above(&[axes.directions(), line])?;
            let error =
                request.estimate_error.then(|| goniometer::interpolation_error(&bands, &axes));
            (axes, error)
        }
    };
    goniometer::write(&bands, &axes, form, &request.name, out, control)?;
    let mut line = format!("{} directions, {} wavelengths", axes.directions(), bands.nm().len());
    if let Some(error) = error {
        line += &format!("; between the nodes {}", error_of_f(error.median, error.quantile_95));
    }
    Ok(line)
}
