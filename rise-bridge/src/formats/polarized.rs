//! Writer of `.pbsdf` for Mitsuba.

use std::io::Write;

use mist_engine::{Control, material::PreparedMaterial};

use super::export::ExportRequest;
use crate::{
    export::ExportError,
    mitsuba::{axes::HalfAngleAxes, pbsdf},
};

/// Nodes of a table for which no grid was asked.
const GRID: &str = "37x46x91";

/// Writes the table; the line has the error of interpolation of all Mueller elements.
pub(super) fn write(
    material: &PreparedMaterial,
    request: &ExportRequest,
    out: &mut dyn Write,
    control: &Control,
) -> Result<String, ExportError> {
    let nm = request.wavelengths("450,500,550,600,650")?;
    let bands = pbsdf::bands(material, &nm, !request.plugin)?;
    let grid = request.grid.as_deref().unwrap_or(GRID);
    let (axes, error) = match request.tolerance(grid)? {
        Some(part) => {
            let (axes, error) = pbsdf::choose_axes(&bands, part, request.uniform)?;
            (axes, Some(error))
        }
        None => {
            let axes = HalfAngleAxes::parse(grid, request.uniform)?;
            request.refuse_above(&[axes.nodes(), nm.len(), 64])?;
            let error = request.estimate_error.then(|| pbsdf::interpolation_error(&bands, &axes));
            (axes, error)
        }
    };
    let description = request.description("Mueller BRDF, 1/sr, no cosine");
    pbsdf::write(&bands, &axes, &description, out, control)?;
    let [phi_d, theta_d, theta_h] = axes.counts();
    let mut line = format!("{phi_d}x{theta_d}x{theta_h} nodes, {} wavelengths", nm.len());
    if let Some(error) = error {
        line += &format!(
            "; between the nodes the error of M00 is {:.2} % (median) and {:.2} % (95 % of the \
             light), of all elements {:.2} %",
            100.0 * error.median,
            100.0 * error.quantile_95,
            100.0 * error.polarization,
        );
    }
    Ok(line)
}
