//! `.pbsdf` for Mitsuba.

use rise_bridge::mitsuba::{axes::HalfAngleAxes, pbsdf};

use super::{Stop, Work, not_exported, tolerance};

/// Nodes of a table for which no grid was asked.
const GRID: &str = "37x46x91";

/// Writes the table and tells how far it is from the material between its nodes.
pub(super) fn write(work: &Work<'_>) -> Result<String, Stop> {
    let args = work.args;
    let bands = pbsdf::bands(&work.material, &work.wavelengths, !args.plugin);
    let bands = bands.map_err(not_exported)?;
    let grid = args.grid.as_deref().unwrap_or(GRID);
    let (axes, spread) = match tolerance(grid)? {
        Some(part) => pbsdf::choose_axes(&bands, part, args.uniform).map_err(not_exported)?,
        None => {
            let axes = HalfAngleAxes::parse(grid, args.uniform).map_err(not_exported)?;
            let spread = pbsdf::interpolation_error(&bands, &axes);
            (axes, spread)
        }
    };
    let description = work.description("Mueller BRDF, 1/sr, no cosine");
    work.save(|file| pbsdf::write(&bands, &axes, &description, file, work.control))?;
    let [phi_d, theta_d, theta_h] = axes.counts();
    Ok(format!(
        "{}: {phi_d}x{theta_d}x{theta_h} nodes, {} wavelengths; between the nodes the error of M00 \
         is {:.2} % (median) and {:.2} % (95 % of the light), of all elements {:.2} %\n",
        work.path.display(),
        bands.nm().len(),
        100.0 * spread.median,
        100.0 * spread.quantile_95,
        100.0 * spread.polarization,
    ))
}
